#pragma once
// The true motion of the simulated wheels, to compare with the controller's report.

#include <cmath>
#include <optional>

#include "sim/pioneer/simulated_pioneer.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::test {

/// Drives steadily on a line or a circle and ignores commands, except those of the watchdog.
class EvenChassis final : public sim::Chassis {
 public:
  explicit EvenChassis(const sim::Twist& driven) : twist(driven) {}

  sim::Twist twist;
  double track_m = 2.0 / 5.6;

  sim::WheelMotion roll_to(Stamp until) override {
    const double passed_s = to_seconds(until - last_);
    last_ = until;
    const double forward_m = twist.speed_m_per_s * passed_s, turn_rad = twist.turn_rate_rad_per_s * passed_s;
    return {forward_m - turn_rad * track_m / 2, forward_m + turn_rad * track_m / 2, turn_rad};
  }
  void drive(const std::optional<sim::Twist>& ordered) override {
    held = ordered.has_value();  // only the watchdog orders in these tests
    if (held) twist = *ordered;
  }
  void hurry(double speed_m_per_s) override { twist.speed_m_per_s = speed_m_per_s; }

  bool held = false;

 private:
  Stamp last_{};
};

/// Wraps another chassis and integrates the motion of its wheels exactly.
class WheelReference final : public sim::Chassis {
 public:
  /// `chassis` must outlive this object.
  WheelReference(sim::Chassis& chassis, double track_m) : chassis_(chassis), track_m_(track_m) {}

  sim::WheelMotion roll_to(Stamp until) override {
    const sim::WheelMotion rolled = chassis_.roll_to(until);
    const double forward_m = (rolled.left_m + rolled.right_m) / 2;
    const double turn_rad = (rolled.right_m - rolled.left_m) / track_m_;
    const double chord_m = forward_m * (turn_rad == 0.0 ? 1.0 : std::sin(turn_rad / 2) / (turn_rad / 2));
    T_odom_body_ = T_odom_body_ * Pose2{chord_m * std::cos(turn_rad / 2), chord_m * std::sin(turn_rad / 2), turn_rad};
    path_m_ += std::abs(forward_m);
    rolled_to_ = until;
    return rolled;
  }
  void drive(const std::optional<sim::Twist>& ordered) override { chassis_.drive(ordered); }
  void hurry(double speed_m_per_s) override { chassis_.hurry(speed_m_per_s); }

  // State at rolled_to().
  const Pose2& T_odom_body() const { return T_odom_body_; }
  double path_m() const { return path_m_; }
  Stamp rolled_to() const { return rolled_to_; }

 private:
  sim::Chassis& chassis_;
  double track_m_;
  Pose2 T_odom_body_;
  double path_m_ = 0.0;
  Stamp rolled_to_{};
};

}  // namespace azimuth::test
