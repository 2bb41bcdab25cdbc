#pragma once
// The real driver on the simulated controller, in virtual time. Nothing waits and no descriptor is open.

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "drivers/pioneer/driver.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"
#include "tests/robot/virtual_adapter.hpp"
#include "tests/robot/wheel_reference.hpp"

namespace azimuth::test {

/// A reading, and what the wheels really did by the instant that the controller looked at them.
struct Sighting {
  OdometryReading reading;
  Stamp taken_at{};  ///< when the driver had it
  Stamp latched_at{};
  Pose2 T_odom_wheels;
  double path_m = 0.0;  ///< of the wheels
  Duration stamp_error() const { return reading.stamp - latched_at; }
};

struct RobotSetup {
  sim::PioneerModel model;
  PioneerSettings settings;
  AdapterSettings adapter;
  std::uint64_t seed = 1;
};

/// Everything is a function of setup, chassis and what the test does when.
class DrivenRobot {
 public:
  /// `chassis` outlives this.
  DrivenRobot(const RobotSetup& setup, sim::Chassis& chassis);
  ~DrivenRobot();
  DrivenRobot(const DrivenRobot&) = delete;
  DrivenRobot& operator=(const DrivenRobot&) = delete;

  Stamp now() const { return now_; }
  void run(Duration duration) { run_until(now_ + duration); }
  void run_until(Stamp end);
  /// Runs until the driver has a reading, at most so long; false: it has none.
  bool run_to_reading(Duration at_most);
  /// By the simulator's name for it.
  void fault(std::string_view text);

  PioneerDriver& driver() { return driver_; }
  const PioneerState& state() const { return driver_.state(); }
  sim::SimulatedPioneer& pioneer() { return pioneer_; }
  /// Of the present instant, as far as the controller has looked.
  const WheelReference& wheels() const { return wheels_; }

  std::vector<Sighting> sightings;
  std::vector<std::string> events;
  std::function<void(const Sighting&)> on_sighting = [](const Sighting&) {};
  std::uint64_t turns = 0;                    ///< of the driver
  std::size_t allocations_while_running = 0;  ///< in turns that began and ended with odometry coming

 private:
  struct Latch {
    Stamp at{};
    Pose2 T_odom_wheels;
    double path_m = 0.0;
  };
  void step(Stamp now);
  void turn_driver();
  void note_latches();
  void note(const OdometryReading& reading);
  const Latch& latch_nearest(Stamp stamp) const;

  WheelReference wheels_;
  sim::SimulatedPioneer pioneer_;
  VirtualAdapter adapter_;
  PioneerDriver driver_;
  std::deque<Latch> latches_;  // the newest
  Stamp now_{}, driver_due_{};
};

}  // namespace azimuth::test
