#pragma once
// How a camera that looks up sees a lamp, without a singularity above the horizon.
//
// The camera measures the lamp's horizontal offset per metre of height above the camera, m, in the robot's frame. A
// lamp straight above has m = 0; towards the horizon m grows without bound. For a lamp at (q, z), and for one first
// seen from a, in the direction g (also an offset per metre), at the inverse height w = 1 / (z - camera):
//
//   m = R(heading)^T (q - p) / (z - camera),   m = R(heading)^T (w (a - p) + g)
//
// The second form is linear in w and holds at w = 0, for a lamp infinitely high. A lamp can therefore be mapped from
// its first observation on, with a guess of its height, long before there is any parallax (the same idea as inverse
// depth, Civera, Davison, Montiel 2008, but linear).

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "slam/geometry/pose2.hpp"
#include "slam/geometry/tangent_direction.hpp"

namespace azimuth {

/// A lamp as its first observation describes it; the state order is (anchor, offset per metre, inverse height).
struct InverseHeight {
  Eigen::Vector2d anchor;            ///< Position of the camera in the map
  Eigen::Vector2d offset_per_metre;  ///< g: towards the lamp, axes of the map
  double inverse_height_per_m;       ///< w: of the height above the camera
};

/// m with its derivatives by the robot's pose (x, y, heading) and by the lamp's entries.
template <int LampSize>
struct LampOffset {
  Eigen::Vector2d m;
  Eigen::Matrix<double, 2, 3> by_pose;
  Eigen::Matrix<double, 2, LampSize> by_lamp;
};

/// R(heading)^T, and the derivative of R^T v by the heading.
inline Eigen::Matrix2d to_body(double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  return Eigen::Matrix2d{{c, s}, {-s, c}};
}
inline Eigen::Vector2d turned_back(const Eigen::Vector2d& v) { return {v.y(), -v.x()}; }

/* by_pose = [-w R^T, d], by_lamp = [w R^T, R^T, R^T (a - p)], d = (m_y, -m_x) */
inline LampOffset<5> predict_offset(const Pose2& T_map_body, const InverseHeight& lamp) {
  const Eigen::Matrix2d R_body_map = to_body(T_map_body.heading_rad);
  const Eigen::Vector2d from_robot = lamp.anchor - T_map_body.position();
  const double w = lamp.inverse_height_per_m;
  LampOffset<5> seen;
  seen.m = R_body_map * (w * from_robot + lamp.offset_per_metre);
  seen.by_pose << -w * R_body_map, turned_back(seen.m);
  seen.by_lamp << w * R_body_map, R_body_map, R_body_map * from_robot;
  return seen;
}

/// The offset of a lamp at `p_map`, z counting from the map's zero of heights. Nothing when the lamp is less than
/// `min_height_m` above the camera.
/* by_pose = [-R^T / dz, d], by_lamp = [R^T / dz, -m / dz] */
inline std::optional<LampOffset<3>> predict_offset(const Pose2& T_map_body, const Eigen::Vector3d& p_map,
                                                   double camera_height_m, double min_height_m) {
  const double height_m = p_map.z() - camera_height_m;
  if (!(height_m >= min_height_m)) return std::nullopt;
  const Eigen::Matrix2d R_body_map = to_body(T_map_body.heading_rad) / height_m;
  LampOffset<3> seen;
  seen.m = R_body_map * (p_map.head<2>() - T_map_body.position());
  seen.by_pose << -R_body_map, turned_back(seen.m);
  seen.by_lamp << R_body_map, -seen.m / height_m;
  return seen;
}

/// The point that an inverse height describes, with its derivative by (anchor, offset, inverse height). The inverse
/// height must not be 0.
inline Eigen::Vector3d point_of(const InverseHeight& lamp, double camera_height_m,
                                Eigen::Matrix<double, 3, 5>* jacobian = nullptr) {
  const double height_m = 1.0 / lamp.inverse_height_per_m;
  const Eigen::Vector2d offset_m = height_m * lamp.offset_per_metre;
  if (jacobian != nullptr)
    *jacobian << 1.0, 0.0, height_m, 0.0, -height_m * offset_m.x(),  //
        0.0, 1.0, 0.0, height_m, -height_m * offset_m.y(),           //
        0.0, 0.0, 0.0, 0.0, -height_m * height_m;
  const Eigen::Vector2d q = lamp.anchor + offset_m;
  return {q.x(), q.y(), camera_height_m + height_m};
}

}  // namespace azimuth
