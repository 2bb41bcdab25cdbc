#pragma once
// World, robot and serial line in virtual time: all of azimuth-sim except descriptors and clocks.

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/azimuth_sim/can_base.hpp"
#include "sim/azimuth_sim/rover.hpp"
#include "sim/pioneer/fault_schedule.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"
#include "sim/world/simulate.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth::sim {

struct SimulationSettings {
  Scenario scenario;
  PioneerModel model;
  FaultSchedule faults;
  std::optional<Duration> frame_period;  ///< nullopt: no images are taken
  bool has_can_base = false;             ///< Whether the base reports on a CAN bus
  LeftAlone left_alone = LeftAlone::follows_its_path;
};

/// The instant of an image and the robot's pose then.
struct FrameInstant {
  Stamp stamp{};
  Pose2 T_world_body;
};

/// The events of a simulation step, in order. Stamps are in virtual time.
struct SimulationOutput {
  std::vector<BearingSet> bearings;
  std::vector<TruePose> truth;
  /// Readings of an ideal reader of the wheels. The Pioneer's odometry is on the serial line.
  std::vector<OdometryReading> odometry;
  std::vector<FrameInstant> frames;
  std::vector<CanFrame> can_frames;
  std::vector<SipLatch> latches;
  std::vector<Fault> faults;  ///< Faults that became active

  void clear();
};

/// Simulates the robot. The truth is output at every tick of the drive, within which the motion is a straight line: for
/// a robot that turns on the spot, interpolation between distant samples would be wrong.
///
/// The output is a function of the settings and of what the client sends when; it does not depend on how often
/// advance() is called. Thread contract: thread-bound.
class Simulation {
 public:
  explicit Simulation(const SimulationSettings& settings);

  SimulatedPioneer& pioneer() { return pioneer_; }
  const Rover& rover() const { return rover_; }
  /// The true pose of the robot; `now` as in advance().
  Pose2 pose_in_world(Stamp now) { return rover_.pose_in_world(now); }

  /// The latest instant of the next advance().
  Stamp due() const;
  /// Appends the events up to `now` to `output`. `now` must not decrease.
  void advance(Stamp now, SimulationOutput& output);

 private:
  /// Fires at regular intervals.
  class Timer {
   public:
    Timer(Duration period, Duration phase) : period_(period), next_(phase) {}
    Stamp due() const { return next_; }
    bool ring(Stamp now);

   private:
    Duration period_;
    Stamp next_;
  };

  void step(Stamp now, SimulationOutput& output);
  void take_samples(Stamp now, SimulationOutput& output);
  void see(Stamp now, SimulationOutput& output);
  void report_on_can(Stamp now, SimulationOutput& output);

  Scenario scenario_;
  FaultSchedule faults_;
  Rover rover_;
  SimulatedPioneer pioneer_;
  Random bearing_random_;
  Timer truth_, odometry_, bearings_;
  std::optional<Timer> frames_, can_;
  CanBase can_base_;
  std::uint64_t can_reboots_ = 0;
  std::uint64_t odometry_count_ = 0, bearing_count_ = 0;
};

}  // namespace azimuth::sim
