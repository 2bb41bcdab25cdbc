#pragma once

namespace azimuth::sim {

/// Of one axis, in its own unit u: u/s and u/s^2.
struct AxisRamps {
  double acceleration = 0.0, deceleration = 0.0;
};

/// One of the two ways a robot moves: along, in metres, or round, in radians. Either keeps to an ordered speed or goes
/// an ordered way with a trapezoidal profile, which follows what the wheels have counted: what a ramp or a delay made
/// too long is gone back.
///
/// Thread contract: thread-bound.
class Axis {
 public:
  /// A way is at its end when no more than `tolerance` is left of it, either way.
  explicit Axis(double tolerance) : tolerance_(tolerance) {}

  /// Each replaces what was ordered before. `limit`: the highest speed, of this order only.
  void order_speed(double speed, double limit);
  void order_way(double way, double limit);
  /// Stands at once and has nothing to do any more.
  void halt();

  /// What the wheels did.
  void count(double way);
  /// The next `step_s` begin. `held`: the speed goes to zero, what is ordered waits.
  void advance(double step_s, const AxisRamps& ramps, bool held);

  double speed() const { return speed_; }
  /// Of the ordered way; 0 when a speed is ordered.
  double way_left() const { return has_way_ ? way_left_ : 0.0; }

 private:
  double wanted_speed(double step_s, double deceleration) const;

  double tolerance_;
  double speed_ = 0.0, ordered_speed_ = 0.0;
  bool has_way_ = false;
  double way_left_ = 0.0, way_limit_ = 0.0;
};

}  // namespace azimuth::sim
