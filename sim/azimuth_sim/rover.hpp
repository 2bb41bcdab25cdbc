#pragma once
// The robot as a body on two wheels that drives through a scenario.

#include <deque>
#include <memory>
#include <optional>

#include "sim/pioneer/chassis.hpp"
#include "sim/world/random.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth::sim {

/// What a robot does that no client drives.
enum class LeftAlone { follows_its_path, stands };

/// Follows the scenario's path by itself, as another program would drive it, or stands, unless a client of the Pioneer
/// drives.
/// What the wheels turn is what the scenario's odometer would report; where that takes the body is what its noise makes
/// of it. The odometer's lag is not simulated: a controller's SIP tells of the instant of its latch.
///
/// A function of the scenario and of the orders given when. Thread contract: thread-bound; instants never decrease from
/// call to call.
class Rover final : public Chassis {
 public:
  /// `track_m`: between the wheels.
  Rover(const Scenario& scenario, double track_m, LeftAlone left_alone = LeftAlone::follows_its_path);

  WheelMotion roll_to(Stamp until) override;
  void drive(const std::optional<Twist>& ordered) override { ordered_ = ordered; }
  void hurry(double speed_m_per_s) override;

  /// What the wheels did since the start.
  WheelMotion rolled_by(Stamp now);

  Pose2 pose_in_world(Stamp now);  ///< T_world_body
  /// T_odom_body of an odometer that reads the wheels exactly.
  Pose2 pose_in_odom(Stamp now);
  /// How long a motion stays the same at least, unless it is in a hurry.
  Duration tick() const { return tick_; }
  /// Whether the path is at its end and the robot stands there.
  bool arrived() const { return arrived_; }

 private:
  /// Motion within one tick, taken to be even.
  struct Segment {
    Stamp start{}, end{};
    Pose2 T_world_start, T_start_end;
    Pose2 T_odom_start, T_start_end_by_wheels;
    WheelMotion motion;
  };
  void continue_to(Stamp until);
  void begin_segment();
  Control next_control();
  void plan(const Control& control);
  double fraction(Stamp now) const;
  WheelMotion rolled(Stamp now) const;

  DriveSettings drive_;
  OdometerSettings odometer_;
  double track_m_;
  LeftAlone left_alone_;
  std::unique_ptr<Driver> driver_;
  Random random_;
  std::deque<Control> plan_;  // what is left of the driver's last control, tick by tick
  Duration tick_{}, segment_tick_{};
  std::optional<Twist> ordered_;
  bool arrived_ = false;
  Segment segment_;
  WheelMotion rolled_before_;  // all segments before this one
  WheelMotion rolled_taken_;
};

}  // namespace azimuth::sim
