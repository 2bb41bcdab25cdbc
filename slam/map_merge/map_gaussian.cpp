#include "slam/map_merge/map_gaussian.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kHeightSigmas = 4.0;
constexpr double kHeightSlack_m = 0.05;

double cross(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& point) {
  const Eigen::Vector2d side = to - from, off = point - from;
  return side.x() * off.y() - side.y() * off.x();
}

/// Appends one side of the convex hull of sorted points.
template <class Points>
void append_chain(const Points& sorted, std::vector<Eigen::Vector2d>& hull) {
  const std::size_t begin = hull.size();
  for (const Eigen::Vector2d& point : sorted) {
    while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0) hull.pop_back();
    hull.push_back(point);
  }
  hull.pop_back();  // It is the first point of the other side
}

}  // namespace

MapGaussian gaussian_of(const MapSnapshot& map, Kept kept) {
  MapGaussian gaussian;
  gaussian.map = &map;
  const std::size_t first = kept == Kept::everything ? 0 : map.first_landmark_entry();
  const Eigen::Index size = as_index(map.entries() - first);
  gaussian.mean = Eigen::VectorXd::Zero(size);
  gaussian.covariance.resize(size, size);
  for (Eigen::Index c = 0; c < size; ++c)
    for (Eigen::Index r = c; r < size; ++r)
      gaussian.covariance(r, c) = gaussian.covariance(c, r) = map.covariance(first + as_size(r), first + as_size(c));
  Eigen::Index row = as_index(map.first_landmark_entry() - first);
  if (kept == Kept::everything) {
    gaussian.mean.head<3>() = map.T_map_body.vector();
    for (std::size_t i = 0; i < map.camera.size(); ++i) gaussian.mean(as_index(3 + i)) = map.camera[i];
  }
  for (const MapLandmark& landmark : map.landmarks) {
    gaussian.row.push_back(row);
    gaussian.mean.segment<2>(row) = landmark.p_map_landmark_m;
    if (landmark.has_height()) gaussian.mean(row + 2) = landmark.z_map_landmark_m;
    row += as_index(landmark.size());
  }
  return gaussian;
}

bool may_be_one(const MapGaussian& a, const MapGaussian& b, const Correspondence& pair) {
  const MapLandmark &one = a.landmark(pair.a), &other = b.landmark(pair.b);
  const bool named = one.identity != kUnknownIdentity && other.identity != kUnknownIdentity;
  if (named && one.identity != other.identity) return false;
  if (!same_kind(one.kind, other.kind)) return false;
  if (!one.has_height() || !other.has_height()) return true;
  const Eigen::Index row_a = a.row[pair.a] + 2, row_b = b.row[pair.b] + 2;
  const double variance_m2 = a.covariance(row_a, row_a) + b.covariance(row_b, row_b);
  return std::abs(one.z_map_landmark_m - other.z_map_landmark_m) <=
         kHeightSlack_m + kHeightSigmas * std::sqrt(variance_m2);
}

std::vector<Eigen::Vector2d> hull_of(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  };
  std::sort(points.begin(), points.end(), before);
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  append_chain(points, hull);
  std::reverse(points.begin(), points.end());
  append_chain(points, hull);
  return hull;
}

double area_of(std::span<const Eigen::Vector2d> hull) {
  double twice = 0.0;
  for (std::size_t i = 2; i < hull.size(); ++i) twice += cross(hull[0], hull[i - 1], hull[i]);
  return 0.5 * twice;
}

bool contains(std::span<const Eigen::Vector2d> hull, const Eigen::Vector2d& point) {
  if (hull.size() < 3) return false;
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (cross(hull[i], hull[(i + 1) % hull.size()], point) < 0.0) return false;
  return true;
}

std::vector<Eigen::Vector2d> points_of(const MapGaussian& map) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < map.size(); ++i) points.push_back(map.point(i));
  return points;
}

}  // namespace azimuth
