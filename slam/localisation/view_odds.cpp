#include "slam/localisation/view_odds.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace azimuth {
namespace {

constexpr double kNearest_m = 0.05;

bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

constexpr double kAroundMap_m = 5.0;  // a robot is at most this far outside of the map
constexpr double kSlack = 1.1;        // tolerance for the limits of the view
constexpr double kLongestPair_m = 100.0;

/// Share of the map's landmarks that the direction may belong to. The same share of clutter is assumed to have the kind
/// and identity of the direction.
double share_of_looks(const SeenDirection& seen, std::span<const KnownLandmark> landmarks) {
  const auto alike = std::ranges::count_if(landmarks, [&](const KnownLandmark& l) { return may_be(seen, l); });
  return std::max(1.0, static_cast<double>(alike)) / static_cast<double>(std::max<std::size_t>(1, landmarks.size()));
}

/// Size of the part of the sphere, or circle, that directions may cover.
double room(const SeenRay& ray, const CameraView& view) {
  return ray.spatial ? view.field_of_view_rad * (1.0 - std::sin(view.min_elevation_rad)) : view.field_of_view_rad;
}

bool is_usable(const KnownLandmark& landmark) {
  return landmark.p_map_m.head<2>().allFinite() && landmark.covariance_m2.topLeftCorner<2, 2>().allFinite() &&
         (!landmark.has_height() || (std::isfinite(landmark.p_map_m.z()) && landmark.covariance_m2.allFinite()));
}

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

void LandmarkPairs::build(std::span<const KnownLandmark> landmarks, double longest_m) {
  pairs_.clear();
  for (std::size_t a = 0; a < landmarks.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (!landmarks[a].has_height() || !landmarks[b].has_height()) continue;
      const double distance_m = (landmarks[a].p_map_m - landmarks[b].p_map_m).head<2>().norm();
      if (distance_m <= longest_m)
        pairs_.push_back({distance_m, static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b)});
    }
  std::ranges::sort(pairs_, [](const Pair& x, const Pair& y) {
    return std::tie(x.distance_m, x.a, x.b) < std::tie(y.distance_m, y.a, y.b);
  });
}

std::span<const LandmarkPairs::Pair> LandmarkPairs::between(double shortest_m, double longest_m) const {
  const auto first = std::ranges::lower_bound(pairs_, shortest_m, std::less{}, &Pair::distance_m);
  const auto last = std::ranges::upper_bound(pairs_, longest_m, std::less{}, &Pair::distance_m);
  return first < last ? std::span<const Pair>(first, last) : std::span<const Pair>();
}

void KnownMap::assign(std::span<const KnownLandmark> all, const CameraView& camera) {
  landmarks.clear();
  for (const KnownLandmark& landmark : all)
    if (landmarks.size() < kMost && is_usable(landmark)) landmarks.push_back(landmark);
  view = camera;
  tan_min_elevation = std::tan(camera.min_elevation_rad);
  tan_inner_elevation = std::tan(camera.min_elevation_rad + camera.rim * (0.5 * kPi - camera.min_elevation_rad));
  low_m = high_m = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Eigen::Vector2d p = landmarks[i].p_map_m.head<2>();
    low_m = i == 0 ? p : low_m.cwiseMin(p);
    high_m = i == 0 ? p : high_m.cwiseMax(p);
  }
  low_m.array() -= kAroundMap_m;
  high_m.array() += kAroundMap_m;
  log_prior_density = -std::log((high_m - low_m).prod() * 2.0 * kPi);
  pairs.build(landmarks, kLongestPair_m);
}

bool KnownMap::contains(const Pose2& T_map_body) const {
  const Eigen::Array2d p = T_map_body.position().array();
  return (p >= low_m.array()).all() && (p <= high_m.array()).all();
}

InView in_view(const KnownMap& map, const KnownLandmark& landmark, const Eigen::Vector3d& v) {
  const double flat_m = std::sqrt(v.x() * v.x() + v.y() * v.y());
  double reached;  // 1: at the limit of the view
  if (landmark.has_height() && map.tan_min_elevation > 0.0) {
    if (v.z() <= 0.0 || v.z() * kSlack < flat_m * map.tan_min_elevation) return InView::no;
    reached = v.z() > flat_m * map.tan_inner_elevation ? 0.0 : 1.0;
  } else {
    if (flat_m > kSlack * map.view.max_distance_m) return InView::no;
    reached = flat_m / map.view.max_distance_m;
  }
  const double half_rad = 0.5 * map.view.field_of_view_rad;
  if (half_rad < kPi - 1e-6) {
    const double off_rad = std::abs(wrap(std::atan2(v.y(), v.x()) - map.view.yaw_rad));
    if (off_rad > kSlack * half_rad) return InView::no;
    reached = std::max(reached, off_rad / half_rad);
  }
  return reached <= 1.0 - map.view.rim ? InView::yes : InView::at_the_rim;
}

void RaysOfImage::assign(std::span<const SeenDirection> directions, const KnownMap& map, std::size_t most) {
  rays.clear();
  log_room.clear();
  const std::size_t count = std::min(directions.size(), most);
  for (std::size_t i = 0; i < count; ++i)
    if (const auto ray = make_ray(directions[i * directions.size() / count])) {
      rays.push_back(*ray);
      log_room.push_back(std::log(room(*ray, map.view) / share_of_looks(ray->seen, map.landmarks)));
    }
}

}  // namespace azimuth
