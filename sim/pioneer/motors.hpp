#pragma once
// The drive part of the controller: client orders with ramps, stopped by the watchdog.

#include <optional>

#include "sim/pioneer/model.hpp"

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

/// Speed of the robot over ground.
struct Twist {
  double speed_m_per_s = 0.0;
  double turn_rate_rad_per_s = 0.0;
  friend bool operator==(const Twist&, const Twist&) = default;
};

/// Whether and how a client drives. Azimuth itself never drives, but other programs may connect.
///
/// Translation and rotation are ordered independently, each as a speed or as a distance; the newest order of each is in
/// effect. An order for the two wheels replaces both orders; a later order for translation or rotation cancels the
/// wheel order.
///
/// Thread contract: thread-bound.
class Motors {
 public:
  explicit Motors(const PioneerModel& model) : model_(model), limits_(model.usual) {}

  void enable(bool on);
  bool enabled() const { return enabled_; }
  /// Stops at once, until the next order.
  void emergency_stop();
  bool emergency_stopped() const { return emergency_stopped_; }

  // Orders; they have no effect while the motors are off.

  void order_speed(double speed_m_per_s);
  void order_turn_rate(double turn_rate_rad_per_s);
  void order_wheels(double left_m_per_s, double right_m_per_s);
  void order_distance(double distance_m);  ///< Negative: backwards
  void order_turn(double turn_rad);        ///< Relative to the current heading; positive: counter-clockwise
  void stop();
  /// Ends the session: orders are cancelled and limits reset.
  void release();

  /// Sets a limit, up to that of the robot; 0 changes nothing. Speed limits apply to later orders.
  void limit(int MotionLimits::*which, int value);
  const MotionLimits& limits() const { return limits_; }

  /// Motion counted by the wheels since the last call.
  void count(double distance_m, double turn_rad);
  /// Rest of an ordered rotation; 0 if none is ordered.
  double turn_left_rad() const { return turning_.way_left(); }

  /// The watchdog's hold: the wheels stand; orders are kept and resumed.
  void hold(bool held) { held_ = held; }
  bool held() const { return held_; }

  /// Begins the next `step_s`: ramps the motion towards the orders.
  void advance(double step_s);

  /// The current motion, if a client has given any order since the session began.
  std::optional<Twist> driven() const;

 private:
  bool begin_order();
  double speed_limit_m_per_s() const { return limits_.speed_mm_per_s / 1000.0; }
  double turn_rate_limit_rad_per_s() const;

  static constexpr double kTolerance_m = 2e-4, kTolerance_rad = 1e-3;  // Below the resolution of a SIP

  PioneerModel model_;
  MotionLimits limits_;
  bool enabled_ = false, emergency_stopped_ = false, held_ = false, driving_ = false;
  bool orders_wheels_ = false;  // Whether the newest order is for the wheels
  Axis moving_{kTolerance_m}, turning_{kTolerance_rad};
};

}  // namespace azimuth::sim
