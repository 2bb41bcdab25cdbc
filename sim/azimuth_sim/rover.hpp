#pragma once
// The robot as a two-wheeled body that drives through a scenario.

#include <deque>
#include <memory>
#include <optional>

#include "sim/pioneer/simulated_pioneer.hpp"
#include "sim/world/random.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth::sim {

/// The robot's behaviour while no client drives.
enum class LeftAlone { follows_its_path, stands };

/// A robot that follows the scenario's path by itself, as if driven by another program, or stands, unless a client of
/// the Pioneer drives it. The wheels turn as the scenario's odometer would report; the odometer's noise determines the
/// motion of the body. The odometer's lag is not simulated, since the SIP of a controller gives the pose at its latch
/// instant.
///
/// The motion is a function of the scenario and of the orders and their instants. Thread contract: thread-bound;
/// instants must not decrease from call to call.
class Rover final : public Chassis {
 public:
  /// `track_m`: distance between the wheels.
  Rover(const Scenario& scenario, double track_m, LeftAlone left_alone = LeftAlone::follows_its_path);

  WheelMotion roll_to(Stamp until) override;
  void drive(const std::optional<Twist>& ordered) override { ordered_ = ordered; }
  void hurry(double speed_m_per_s) override;

  /// Motion of the wheels since the start.
  WheelMotion rolled_by(Stamp now);

  Pose2 pose_in_world(Stamp now);  ///< T_world_body
  /// T_odom_body of an odometer that reads the wheels exactly.
  Pose2 pose_in_odom(Stamp now);
  /// Duration for which a motion stays constant at least, unless hurry() shortens it.
  Duration tick() const { return tick_; }
  /// Whether the robot stands at the end of the path.
  bool arrived() const { return arrived_; }

 private:
  /// Motion within one tick, taken as uniform.
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
  std::deque<Control> plan_;  // Remaining part of the driver's last control, by ticks
  Duration tick_{}, segment_tick_{};
  std::optional<Twist> ordered_;
  bool arrived_ = false;
  Segment segment_;
  WheelMotion rolled_before_;  // Motion of the wheels in all segments before segment_
  WheelMotion rolled_taken_;
};

}  // namespace azimuth::sim
