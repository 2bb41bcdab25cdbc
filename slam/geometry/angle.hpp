#pragma once
// Angles in radians.

#include <cmath>
#include <numbers>

namespace azimuth {

inline constexpr double kPi = std::numbers::pi;

/// The angle in [-pi, pi) that differs from `angle_rad` by a multiple of 2 pi.
/// `angle_rad` must be finite.
inline double wrap(double angle_rad) {
  if (angle_rad >= -kPi && angle_rad < kPi) return angle_rad;
  const double turned = std::remainder(angle_rad, 2.0 * kPi);  // [-pi, pi], exact
  return turned >= kPi ? turned - 2.0 * kPi : turned;
}

constexpr double degrees_to_rad(double degrees) { return degrees * kPi / 180.0; }
constexpr double rad_to_degrees(double radians) { return radians * 180.0 / kPi; }

}  // namespace azimuth
