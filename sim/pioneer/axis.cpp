#include "sim/pioneer/axis.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace azimuth::sim
