#pragma once
// World, robot and line together, in virtual time: all that azimuth-sim is apart from descriptors and clocks.

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
  std::optional<Duration> frame_period;  ///< none: no images are taken
  bool has_can_base = false;             ///< the base reports on a CAN bus
  LeftAlone left_alone = LeftAlone::follows_its_path;
};

/// Where a camera is when it takes an image.
struct FrameInstant {
  Stamp stamp{};
  Pose2 T_world_body;
};

/// What happened, in order; stamps are virtual.
struct SimulationOutput {
  std::vector<BearingSet> bearings;
  std::vector<TruePose> truth;
  std::vector<OdometryReading> odometry;  ///< of an ideal reader of the wheels; the Pioneer's is on the line
  std::vector<FrameInstant> frames;
  std::vector<CanFrame> can_frames;
  std::vector<SipLatch> latches;
  std::vector<Fault> faults;  ///< that have come

  void clear();
};

/// The truth is told at every tick of the drive, between which it is a straight line: a robot that turns on the spot
/// and drives on is nowhere near the line between two samples that are far apart.
///
/// Everything is a function of settings and of what the client sends when: how often advance() is called changes
/// nothing. Thread contract: thread-bound.
class Simulation {
 public:
  explicit Simulation(const SimulationSettings& settings);

  SimulatedPioneer& pioneer() { return pioneer_; }
  const Rover& rover() const { return rover_; }
  /// Where the robot really is; `now` as in advance().
  Pose2 pose_in_world(Stamp now) { return rover_.pose_in_world(now); }

  /// When advance() is to be called next, at the latest.
  Stamp due() const;
  /// Appends to `output`. `now` never decreases.
  void advance(Stamp now, SimulationOutput& output);

 private:
  /// Rings at even intervals.
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
