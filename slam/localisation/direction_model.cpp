#include "slam/localisation/direction_model.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kNearest_m = 0.05;

bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

std::optional<SeenRay> make_ray(const SeenDirection& seen) {
  if (!std::isfinite(seen.azimuth_rad) || !is_positive(seen.sigma_rad)) return std::nullopt;
  SeenRay ray;
  ray.seen = seen;
  const double c = std::cos(seen.azimuth_rad), s = std::sin(seen.azimuth_rad);
  ray.spatial = std::isfinite(seen.elevation_rad) && is_positive(seen.sigma_elevation_rad);
  const double cos_up = ray.spatial ? std::cos(seen.elevation_rad) : 1.0;
  const double sin_up = ray.spatial ? std::sin(seen.elevation_rad) : 0.0;
  ray.along = {cos_up * c, cos_up * s, sin_up};
  ray.across = {-s, c, 0.0};
  ray.up = {-sin_up * c, -sin_up * s, cos_up};
  // Near the zenith the azimuth is uncertain but the direction is not: across is known as well as along.
  const double across_rad = ray.spatial ? std::min(std::abs(cos_up) * seen.sigma_rad, 1.0) : seen.sigma_rad;
  const double floor_rad = ray.spatial ? 0.1 * seen.sigma_elevation_rad : 0.0;
  ray.variance_across = std::max(across_rad * across_rad, floor_rad * floor_rad);
  if (ray.spatial) ray.variance_up = seen.sigma_elevation_rad * seen.sigma_elevation_rad;
  return ray;
}

SeenRay flattened(const SeenRay& ray) {
  SeenRay flat = ray;
  flat.along = {std::cos(ray.seen.azimuth_rad), std::sin(ray.seen.azimuth_rad), 0.0};
  flat.variance_across = ray.seen.sigma_rad * ray.seen.sigma_rad;
  flat.spatial = false;
  return flat;
}

std::optional<Appearance> appearance(const Pose2& T_map_body, const SeenRay& ray, const KnownLandmark& landmark,
                                     double camera_height_m) {
  if (ray.spatial && !landmark.has_height()) return appearance(T_map_body, flattened(ray), landmark, camera_height_m);
  const CameraPlace from(T_map_body, camera_height_m);
  Eigen::Vector3d v = from(landmark);
  if (!ray.spatial) v.z() = 0.0;
  const double s = ray.along.dot(v);
  if (!(s > kNearest_m)) return std::nullopt;
  Appearance seen;
  seen.rows = ray.spatial ? 2 : 1;
  const Eigen::Vector2d expected(ray.across.dot(v) / s, ray.spatial ? ray.up.dot(v) / s : 0.0);
  seen.innovation = -expected;
  Eigen::Matrix<double, 2, 3> by_v;
  by_v.row(0) = (ray.across - expected.x() * ray.along).transpose() / s;
  by_v.row(1).setZero();
  if (ray.spatial) by_v.row(1) = (ray.up - expected.y() * ray.along).transpose() / s;
  Eigen::Matrix3d R;  // dv/dq
  R << from.cos, from.sin, 0.0, -from.sin, from.cos, 0.0, 0.0, 0.0, ray.spatial ? 1.0 : 0.0;
  const Eigen::Matrix<double, 2, 3> by_q = by_v * R;
  seen.by_pose.leftCols<2>() = -by_q.leftCols<2>();
  seen.by_pose.col(2) = by_v * Eigen::Vector3d(v.y(), -v.x(), 0.0);
  const Eigen::Index n = ray.spatial ? 3 : 2;  // relevant coordinates of the position
  seen.noise = by_q.leftCols(n) * landmark.covariance_m2.topLeftCorner(n, n) * by_q.leftCols(n).transpose();
  seen.noise(0, 0) += ray.variance_across;
  seen.noise(1, 1) += ray.spatial ? ray.variance_up : 1.0;
  return seen;
}

}  // namespace azimuth
