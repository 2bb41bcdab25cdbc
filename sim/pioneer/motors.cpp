#include "sim/pioneer/motors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "slam/geometry/angle.hpp"

namespace azimuth::sim {

void Axis::order_speed(double speed, double limit) {
  has_way_ = false;
  ordered_speed_ = std::clamp(speed, -limit, limit);
}

void Axis::order_way(double way, double limit) {
  has_way_ = true;
  way_left_ = way;
  way_limit_ = limit;
}

void Axis::halt() {
  has_way_ = false;
  speed_ = ordered_speed_ = 0.0;
}

void Axis::count(double way) {
  if (has_way_) way_left_ -= way;
}

void Axis::advance(double step_s, const AxisRamps& ramps, bool held) {
  const double wanted = held ? 0.0 : wanted_speed(step_s, ramps.deceleration);
  const bool speeds_up = wanted * speed_ >= 0.0 && std::abs(wanted) > std::abs(speed_);
  const double most = step_s * (speeds_up ? ramps.acceleration : ramps.deceleration);
  speed_ += std::clamp(wanted - speed_, -most, most);
}

/// The speed v at which the remaining distance suffices for two more steps, since an order takes effect late, and then
/// for stopping: v T + v^2 / (2 a) = distance left, where T is two steps. While the distance shrinks, v falls no faster
/// than `deceleration`.
double Axis::wanted_speed(double step_s, double deceleration) const {
  if (!has_way_) return ordered_speed_;
  if (std::abs(way_left_) <= tolerance_) return 0.0;
  const double reserve = 2.0 * step_s * deceleration;
  const double stopping = std::sqrt(reserve * reserve + 2.0 * deceleration * std::abs(way_left_)) - reserve;
  return std::copysign(std::min(stopping, way_limit_), way_left_);
}

void Motors::enable(bool on) {
  enabled_ = on;
  emergency_stopped_ = false;
  if (!on) stop();
}

void Motors::emergency_stop() {
  emergency_stopped_ = true;
  moving_.halt();
  turning_.halt();
}

/// Whether an order is accepted now. It cancels an order for the wheels.
bool Motors::begin_order() {
  if (!enabled_) return false;
  if (orders_wheels_) stop();
  emergency_stopped_ = orders_wheels_ = false;
  driving_ = true;
  return true;
}

void Motors::order_speed(double speed_m_per_s) {
  if (begin_order()) moving_.order_speed(speed_m_per_s, speed_limit_m_per_s());
}

void Motors::order_turn_rate(double turn_rate_rad_per_s) {
  if (begin_order()) turning_.order_speed(turn_rate_rad_per_s, turn_rate_limit_rad_per_s());
}

void Motors::order_wheels(double left_m_per_s, double right_m_per_s) {
  if (!begin_order()) return;
  const double track_m = model_.track_mm / 1000.0;
  moving_.order_speed((left_m_per_s + right_m_per_s) / 2, speed_limit_m_per_s());
  turning_.order_speed((right_m_per_s - left_m_per_s) / track_m, turn_rate_limit_rad_per_s());
  orders_wheels_ = true;
}

void Motors::order_distance(double distance_m) {
  if (begin_order()) moving_.order_way(distance_m, speed_limit_m_per_s());
}

void Motors::order_turn(double turn_rad) {
  if (begin_order()) turning_.order_way(turn_rad, turn_rate_limit_rad_per_s());
}

void Motors::stop() {
  moving_.order_speed(0.0, 0.0);
  turning_.order_speed(0.0, 0.0);
}

void Motors::release() {
  moving_.halt();
  turning_.halt();
  enabled_ = driving_ = held_ = emergency_stopped_ = orders_wheels_ = false;
  limits_ = model_.usual;
}

void Motors::limit(int MotionLimits::*which, int value) {
  if (value != 0) limits_.*which = std::min(std::abs(value), model_.top.*which);
}

void Motors::count(double distance_m, double turn_rad) {
  moving_.count(distance_m);
  turning_.count(turn_rad);
}

void Motors::advance(double step_s) {
  const bool still = !enabled_ || held_ || emergency_stopped_;
  moving_.advance(step_s, {limits_.acceleration_mm_per_s2 / 1000.0, limits_.deceleration_mm_per_s2 / 1000.0}, still);
  turning_.advance(
      step_s,
      {degrees_to_rad(limits_.turn_acceleration_deg_per_s2), degrees_to_rad(limits_.turn_deceleration_deg_per_s2)},
      still);
}

std::optional<Twist> Motors::driven() const {
  if (!driving_) return std::nullopt;
  return Twist{moving_.speed(), turning_.speed()};
}

double Motors::turn_rate_limit_rad_per_s() const { return degrees_to_rad(limits_.turn_rate_deg_per_s); }

}  // namespace azimuth::sim
