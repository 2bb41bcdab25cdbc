#pragma once
// Predicted azimuth of a landmark (mathematics I.6, eq 30 to 33), for points and for rays in inverse depth.

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// An azimuth with its derivatives. Frames: pose and landmark in the map, azimuth from the robot's heading.
template <int LandmarkSize>
struct PredictedBearing {
  double azimuth_rad;                                  ///< In [-pi, pi)
  Eigen::RowVector3d by_pose;                          ///< d(azimuth) / d(x, y, heading)
  Eigen::Matrix<double, 1, LandmarkSize> by_landmark;  ///< d(azimuth) / d(landmark)
};

/// h = wrap(atan2(y_f - y_v, x_f - x_v) - phi), eq 30. Nothing for a landmark nearer than `min_distance_m`, where the
/// model breaks down.
inline std::optional<PredictedBearing<2>> predict_bearing(const Pose2& T_map_body,
                                                          const Eigen::Vector2d& p_map_landmark,
                                                          double min_distance_m) {
  const double dx = p_map_landmark.x() - T_map_body.x_m, dy = p_map_landmark.y() - T_map_body.y_m;
  const double q = dx * dx + dy * dy;
  if (!(q >= min_distance_m * min_distance_m) || q == 0.0) return std::nullopt;
  return PredictedBearing<2>{wrap(std::atan2(dy, dx) - T_map_body.heading_rad),
                             {dy / q, -dx / q, -1.0},  // eq 32
                             {-dy / q, dx / q}};       // eq 33
}

/// A landmark on a ray: first seen from `anchor`, in the absolute direction `bearing_rad`, at the distance 1 /
/// `inverse_distance_per_m`; 0 is infinity. The state order is (anchor x, anchor y, bearing, inverse distance).
struct InverseDepth {
  Eigen::Vector2d anchor;
  double bearing_rad;
  double inverse_distance_per_m;

  Eigen::Vector2d direction() const { return {std::cos(bearing_rad), std::sin(bearing_rad)}; }
};

/// The direction to anchor + direction / rho is that of m = rho (anchor - p) + direction, which stays finite for rho =
/// 0. Nothing when the point is nearer than `min_distance_m`.
inline std::optional<PredictedBearing<4>> predict_bearing(const Pose2& T_map_body, const InverseDepth& ray,
                                                          double min_distance_m) {
  const double rho = ray.inverse_distance_per_m;
  const Eigen::Vector2d from_robot = ray.anchor - T_map_body.position();
  const Eigen::Vector2d m = rho * from_robot + ray.direction();
  const double q = m.squaredNorm();
  const double nearest = min_distance_m * std::abs(rho);
  if (!(q > nearest * nearest) || q < 1e-12) return std::nullopt;
  const Eigen::RowVector2d by_m(-m.y() / q, m.x() / q);  // d(atan2) / dm
  PredictedBearing<4> predicted;
  predicted.azimuth_rad = wrap(std::atan2(m.y(), m.x()) - T_map_body.heading_rad);
  predicted.by_pose << -rho * by_m, -1.0;
  predicted.by_landmark << rho * by_m, by_m.dot(Eigen::RowVector2d(-ray.direction().y(), ray.direction().x())),
      by_m.dot(from_robot);
  return predicted;
}

/// Relative change in length of the vector whose angle is the azimuth: d(log length) / d(x, y) and / d(landmark).
/// Defined only where predict_bearing() returns a value.
template <int LandmarkSize>
struct Stretch {
  Eigen::RowVector2d by_position;
  Eigen::Matrix<double, 1, LandmarkSize> by_landmark;
};
inline Stretch<2> stretch(const Pose2& T_map_body, const Eigen::Vector2d& p_map_landmark) {
  const Eigen::Vector2d d = p_map_landmark - T_map_body.position();
  const Eigen::RowVector2d by_d = d.transpose() / d.squaredNorm();
  return {-by_d, by_d};
}
inline Stretch<4> stretch(const Pose2& T_map_body, const InverseDepth& ray) {
  const double rho = ray.inverse_distance_per_m;
  const Eigen::Vector2d from_robot = ray.anchor - T_map_body.position(), u = ray.direction();
  const Eigen::Vector2d m = rho * from_robot + u;
  const Eigen::RowVector2d by_m = m.transpose() / m.squaredNorm();
  Stretch<4> result{-rho * by_m, {}};
  result.by_landmark << rho * by_m, by_m.dot(Eigen::RowVector2d(-u.y(), u.x())), by_m.dot(from_robot);
  return result;
}

/// The point that a ray describes, and its derivative by (anchor x, anchor y, bearing, inverse distance).
/// `inverse_distance_per_m` must not be 0.
inline Eigen::Vector2d point_of(const InverseDepth& ray, Eigen::Matrix<double, 2, 4>* jacobian = nullptr) {
  const double distance_m = 1.0 / ray.inverse_distance_per_m;
  const Eigen::Vector2d u = ray.direction();
  if (jacobian != nullptr)
    *jacobian << 1.0, 0.0, -distance_m * u.y(), -distance_m * distance_m * u.x(),  //
        0.0, 1.0, distance_m * u.x(), -distance_m * distance_m * u.y();
  return ray.anchor + distance_m * u;
}

}  // namespace azimuth
