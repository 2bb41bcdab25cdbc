#pragma once

namespace azimuth::sim {

/// Ramps of one axis [u/s^2], where u is the axis's unit: metre or radian.
struct AxisRamps {
  double acceleration = 0.0, deceleration = 0.0;
};

/// One of the robot's two degrees of freedom: translation in metres or rotation in radians. It keeps an ordered speed
/// or covers an ordered distance with a trapezoidal profile. The remaining distance follows the wheel counters, so an
/// overshoot by a ramp or a delay is driven back.
///
/// Thread contract: thread-bound.
class Axis {
 public:
  /// An order of a distance is complete when at most `tolerance` is left, in either direction.
  explicit Axis(double tolerance) : tolerance_(tolerance) {}

  /// Each order replaces the previous one. `limit`: the greatest speed, for this order only.
  void order_speed(double speed, double limit);
  void order_way(double way, double limit);
  /// Stops at once and cancels the order.
  void halt();

  /// Adds motion of the wheels.
  void count(double way);
  /// Begins the next `step_s`. `held`: the speed ramps to zero, the order waits.
  void advance(double step_s, const AxisRamps& ramps, bool held);

  double speed() const { return speed_; }
  /// Rest of an ordered distance; 0 if a speed is ordered.
  double way_left() const { return has_way_ ? way_left_ : 0.0; }

 private:
  double wanted_speed(double step_s, double deceleration) const;

  double tolerance_;
  double speed_ = 0.0, ordered_speed_ = 0.0;
  bool has_way_ = false;
  double way_left_ = 0.0, way_limit_ = 0.0;
};

}  // namespace azimuth::sim
