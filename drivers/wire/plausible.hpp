#pragma once
// Bounds beyond which a value is an error of its source and not a measurement. They are wide: they keep arithmetic
// safe, and catch degrees or millimetres mistaken for radians and metres.

#include <cmath>
#include <cstdint>
#include <limits>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

inline constexpr std::int64_t kMaxStamp_us = 4'000'000'000'000'000'000;  ///< the difference of two stamps still fits
inline constexpr double kMaxCoordinate_m = 1e7;
inline constexpr double kMaxHeading_rad = 1e6;        ///< odometers may count turns
inline constexpr double kMaxAzimuth_rad = 2.0 * kPi;  ///< [-pi, pi) and [0, 2 pi) are both in use
inline constexpr double kMaxRadius_px = 1e6;
inline constexpr double kMaxElevation_rad = 0.5 * kPi;

// All functions return false for NaN.
inline bool is_plausible_stamp(std::int64_t stamp_us) { return stamp_us >= -kMaxStamp_us && stamp_us <= kMaxStamp_us; }
inline bool is_plausible_coordinate(double value_m) { return std::abs(value_m) <= kMaxCoordinate_m; }
inline bool is_plausible_heading(double heading_rad) { return std::abs(heading_rad) <= kMaxHeading_rad; }
inline bool is_plausible_azimuth(double azimuth_rad) { return std::abs(azimuth_rad) <= kMaxAzimuth_rad; }
inline bool is_plausible_elevation(double elevation_rad) { return std::abs(elevation_rad) <= kMaxElevation_rad; }
inline bool is_plausible_sigma(double sigma) { return sigma >= 0.0 && sigma <= kMaxCoordinate_m; }
inline bool is_plausible_kind(std::int64_t kind) {
  return kind >= kAnyKind && kind <= std::numeric_limits<Kind>::max();
}
// A program may send angles in degrees. Such angles are accepted and not wrapped into [-pi, pi), so that the
// estimator's stage can report them (SampleWatch). The stage does not use them.
inline constexpr double kMaxAngle_degrees = 360.0;
inline bool is_angle_or_degrees(double angle) { return std::abs(angle) <= kMaxAngle_degrees; }
inline bool is_plausible_bearing_sigma(double sigma_rad) { return sigma_rad > 0.0 && sigma_rad <= kPi; }
inline bool is_plausible_radius(double radius_px) { return radius_px >= 0.0 && radius_px <= kMaxRadius_px; }
inline bool is_plausible_identity(Identity identity) { return identity >= kUnknownIdentity; }

inline bool is_plausible(const Pose2& pose) {
  return is_plausible_coordinate(pose.x_m) && is_plausible_coordinate(pose.y_m) &&
         is_plausible_heading(pose.heading_rad);
}

inline bool is_plausible(const Bearing& bearing) {
  return is_angle_or_degrees(bearing.azimuth_rad) &&
         (std::isnan(bearing.elevation_rad) || is_angle_or_degrees(bearing.elevation_rad)) &&
         is_plausible_identity(bearing.identity) && is_plausible_kind(bearing.kind) &&
         (std::isnan(bearing.sigma_rad) || is_plausible_bearing_sigma(bearing.sigma_rad)) &&
         (std::isnan(bearing.radius_px) || is_plausible_radius(bearing.radius_px)) &&
         (std::isnan(bearing.sigma_elevation_rad) || is_plausible_bearing_sigma(bearing.sigma_elevation_rad));
}

}  // namespace azimuth
