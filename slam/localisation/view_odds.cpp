#include "slam/localisation/view_odds.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

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
