#include "sim/pioneer/wheel_counter.hpp"

#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth::sim {
namespace {

std::uint16_t position_count(double mm, double mm_per_unit, int bits) {
  const auto units = static_cast<std::int64_t>(std::floor(mm / mm_per_unit));
  return static_cast<std::uint16_t>(units & ((1 << bits) - 1));
}

}  // namespace

/// Adds a fractional number of ticks; returns the number of whole ticks that passed.
double WheelCounter::Encoder::advance(double ticks_more) {
  ticks_exact += ticks_more;
  const auto now = static_cast<std::int64_t>(std::floor(ticks_exact));
  const std::int64_t passed = now - ticks;
  ticks = now;
  return static_cast<double>(passed);
}

std::int16_t heading_count(double heading_rad) {
  return static_cast<std::int16_t>(std::floor(heading_rad * kHeadingCounts / (2.0 * kPi)));
}

WheelCounter::Travel WheelCounter::roll(const WheelMotion& motion) {
  const double left_mm = left_.advance(1000.0 * motion.left_m * model_.ticks_per_mm) / model_.ticks_per_mm;
  const double right_mm = right_.advance(1000.0 * motion.right_m * model_.ticks_per_mm) / model_.ticks_per_mm;
  const double turn_rad = (right_mm - left_mm) / model_.track_mm;
  const double middle_rad = heading_rad_ + turn_rad / 2;
  x_mm_ += (left_mm + right_mm) / 2 * std::cos(middle_rad);
  y_mm_ += (left_mm + right_mm) / 2 * std::sin(middle_rad);
  heading_rad_ = wrap(heading_rad_ + turn_rad);
  return {left_mm, right_mm};
}

void WheelCounter::reset_pose(double x_units, double y_units, double heading_rad) {
  x_mm_ = x_units * model_.mm_per_unit;
  y_mm_ = y_units * model_.mm_per_unit;
  heading_rad_ = wrap(heading_rad);
}

RawPose WheelCounter::raw(int position_bits) const {
  return {position_count(x_mm_, model_.mm_per_unit, position_bits),
          position_count(y_mm_, model_.mm_per_unit, position_bits), heading_count(heading_rad_)};
}

WheelCounter::Travel WheelCounter::take_travel() {
  const auto taken = [this](Encoder& encoder) {
    const std::int64_t passed = encoder.ticks - encoder.ticks_taken;
    encoder.ticks_taken = encoder.ticks;
    return static_cast<double>(passed) / model_.ticks_per_mm;
  };
  return {taken(left_), taken(right_)};
}

}  // namespace azimuth::sim
