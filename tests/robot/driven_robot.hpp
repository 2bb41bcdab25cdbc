#pragma once
// The real driver and the simulated controller in virtual time, without waiting and without descriptors.

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "drivers/pioneer/driver.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"
#include "tests/robot/virtual_adapter.hpp"
#include "tests/robot/wheel_reference.hpp"

namespace azimuth::test {

/// A reading, and the true state of the wheels when the controller sampled them.
struct Sighting {
  OdometryReading reading;
  Stamp taken_at{};  ///< time at which the driver had the reading
  Stamp latched_at{};
  Pose2 T_odom_wheels;
  double path_m = 0.0;  ///< path length of the wheels
  Duration stamp_error() const { return reading.stamp - latched_at; }
};

struct RobotSetup {
  sim::PioneerModel model;
  PioneerSettings settings;
  AdapterSettings adapter;
  std::uint64_t seed = 1;
};

/// The result depends only on the setup, the chassis and the calls of the test.
class DrivenRobot {
 public:
  /// `chassis` must outlive this object.
  DrivenRobot(const RobotSetup& setup, sim::Chassis& chassis);
  ~DrivenRobot();
  DrivenRobot(const DrivenRobot&) = delete;
  DrivenRobot& operator=(const DrivenRobot&) = delete;

  Stamp now() const { return now_; }
  void run(Duration duration) { run_until(now_ + duration); }
  void run_until(Stamp end);
  /// Runs until the driver has a reading, at most for `at_most`; false: no reading.
  bool run_to_reading(Duration at_most);
  /// Triggers a fault, by its name in the simulator.
  void fault(std::string_view text);

  PioneerDriver& driver() { return driver_; }
  const PioneerState& state() const { return driver_.state(); }
  sim::SimulatedPioneer& pioneer() { return pioneer_; }
  /// State of the wheels at the last instant at which the controller sampled them.
  const WheelReference& wheels() const { return wheels_; }

  std::vector<Sighting> sightings;
  std::vector<std::string> events;
  std::function<void(const Sighting&)> on_sighting = [](const Sighting&) {};
  std::uint64_t turns = 0;                    ///< number of calls of the driver's turn()
  std::size_t allocations_while_running = 0;  ///< in turns that started and ended with a running connection

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
  std::deque<Latch> latches_;  // only the newest ones
  Stamp now_{}, driver_due_{};
};

}  // namespace azimuth::test
