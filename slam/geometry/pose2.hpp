#pragma once
// Rigid poses in the plane. A name gives the target frame first: T_world_body maps body coordinates into the world
// frame, and T_world_body * T_body_camera = T_world_camera, where adjacent names cancel.

#include <Eigen/Core>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

/// A pose (x, y, heading). Heading is counter-clockwise from the x axis of the target frame, in [-pi, pi).
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  Eigen::Vector2d position() const { return {x_m, y_m}; }
  Eigen::Vector3d vector() const { return {x_m, y_m, heading_rad}; }
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

inline Eigen::Matrix2d rotation(double turn_rad) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  Eigen::Matrix2d R;
  R << c, -s, s, c;
  return R;
}

/// T_a_c = T_a_b * T_b_c.
inline Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const double c = std::cos(T_a_b.heading_rad), s = std::sin(T_a_b.heading_rad);
  return {T_a_b.x_m + c * T_b_c.x_m - s * T_b_c.y_m, T_a_b.y_m + s * T_b_c.x_m + c * T_b_c.y_m,
          wrap(T_a_b.heading_rad + T_b_c.heading_rad)};
}

/// T_b_a from T_a_b.
inline Pose2 inverse(const Pose2& T_a_b) {
  const double c = std::cos(T_a_b.heading_rad), s = std::sin(T_a_b.heading_rad);
  return {-c * T_a_b.x_m - s * T_a_b.y_m, s * T_a_b.x_m - c * T_a_b.y_m, wrap(-T_a_b.heading_rad)};
}

/// p_a = T_a_b * p_b.
inline Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b) {
  const double c = std::cos(T_a_b.heading_rad), s = std::sin(T_a_b.heading_rad);
  return {T_a_b.x_m + c * p_b.x() - s * p_b.y(), T_a_b.y_m + s * p_b.x() + c * p_b.y()};
}

/// Interpolates between `start` (fraction 0) and `end` (1), with the heading the shorter way round.
inline Pose2 interpolate(const Pose2& start, const Pose2& end, double fraction) {
  return {start.x_m + fraction * (end.x_m - start.x_m), start.y_m + fraction * (end.y_m - start.y_m),
          wrap(start.heading_rad + fraction * wrap(end.heading_rad - start.heading_rad))};
}

}  // namespace azimuth
