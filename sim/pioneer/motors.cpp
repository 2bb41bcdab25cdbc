#include "sim/pioneer/motors.hpp"

#include <algorithm>

#include "slam/geometry/angle.hpp"

namespace azimuth::sim {
namespace {

double towards(double present, double wanted, double most) {
  return present + std::clamp(wanted - present, -most, most);
}

}  // namespace

void Motors::enable(bool on) {
  enabled_ = on;
  emergency_stopped_ = false;
  if (!on) stop();
}

void Motors::emergency_stop() {
  emergency_stopped_ = true;
  ordered_ = present_ = {};
}

void Motors::order_speed(double speed_m_per_s) {
  if (!enabled_) return;
  const double limit = model_.max_velocity_mm_per_s / 1000.0;
  ordered_.speed_m_per_s = std::clamp(speed_m_per_s, -limit, limit);
  driving_ = true;
}

void Motors::order_turn_rate(double turn_rate_rad_per_s) {
  if (!enabled_) return;
  const double limit = degrees_to_rad(model_.max_rotation_deg_per_s);
  ordered_.turn_rate_rad_per_s = std::clamp(turn_rate_rad_per_s, -limit, limit);
  driving_ = true;
}

void Motors::stop() { ordered_ = {}; }

void Motors::release() {
  ordered_ = present_ = {};
  enabled_ = driving_ = held_ = false;
}

void Motors::advance(Stamp now) {
  const double passed_s = to_seconds(now - last_);
  last_ = now;
  const Twist wanted = may_turn() ? ordered_ : Twist{};
  present_.speed_m_per_s =
      towards(present_.speed_m_per_s, wanted.speed_m_per_s, model_.acceleration_mm_per_s2 / 1000.0 * passed_s);
  present_.turn_rate_rad_per_s = towards(present_.turn_rate_rad_per_s, wanted.turn_rate_rad_per_s,
                                         degrees_to_rad(model_.rotation_acceleration_deg_per_s2) * passed_s);
}

}  // namespace azimuth::sim
