#pragma once
// The part of the controller that drives: what clients order, ramped, and stopped by the watchdog.

#include <optional>

#include "sim/pioneer/axis.hpp"
#include "sim/pioneer/model.hpp"

namespace azimuth::sim {

/// Speed of the robot over ground.
struct Twist {
  double speed_m_per_s = 0.0;
  double turn_rate_rad_per_s = 0.0;
  friend bool operator==(const Twist&, const Twist&) = default;
};

/// Whether a client drives, and how. Azimuth itself never does; other programs connect too.
///
/// Along and round are ordered independently of each other, each as a speed or as a way to go; the newest order of each
/// counts. Orders for the two wheels take both, and one of the others then ends what was ordered for the wheels.
///
/// Thread contract: thread-bound.
class Motors {
 public:
  explicit Motors(const PioneerModel& model) : model_(model), limits_(model.usual) {}

  void enable(bool on);
  bool enabled() const { return enabled_; }
  /// Stands at once, until the next order.
  void emergency_stop();
  bool emergency_stopped() const { return emergency_stopped_; }

  // Orders; without effect while the motors are off.

  void order_speed(double speed_m_per_s);
  void order_turn_rate(double turn_rate_rad_per_s);
  void order_wheels(double left_m_per_s, double right_m_per_s);
  void order_distance(double distance_m);  ///< < 0: backwards
  void order_turn(double turn_rad);        ///< from where it faces now; > 0: counter-clockwise
  void stop();
  /// The session is over: nobody drives any more, and limits are the usual ones.
  void release();

  /// Sets a limit, within the robot's own; 0 is none and changes nothing. Speed limits hold for later orders.
  void limit(int MotionLimits::*which, int value);
  const MotionLimits& limits() const { return limits_; }

  /// What the wheels have counted since the last call.
  void count(double distance_m, double turn_rad);
  /// How much of an ordered turn is left; 0 when none is ordered.
  double turn_left_rad() const { return turning_.way_left(); }

  /// The watchdog holds the wheels still; orders stand and are resumed.
  void hold(bool held) { held_ = held; }
  bool held() const { return held_; }

  /// Ramps towards what is ordered; the next `step_s` begin.
  void advance(double step_s);

  /// The present motion, if a client has ordered any since the session began.
  std::optional<Twist> driven() const;

 private:
  bool begin_order();
  double speed_limit_m_per_s() const { return limits_.speed_mm_per_s / 1000.0; }
  double turn_rate_limit_rad_per_s() const;

  static constexpr double kTolerance_m = 2e-4, kTolerance_rad = 1e-3;  // below what a SIP can tell

  PioneerModel model_;
  MotionLimits limits_;
  bool enabled_ = false, emergency_stopped_ = false, held_ = false, driving_ = false;
  bool orders_wheels_ = false;  // the newest order was for the wheels
  Axis moving_{kTolerance_m}, turning_{kTolerance_rad};
};

}  // namespace azimuth::sim
