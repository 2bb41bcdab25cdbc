#include "tools/evaluate/sighting_error.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewestSightings = 3;  // two rays always intersect
constexpr std::size_t kMostHypotheses = 24;  // number of bearings of a landmark of which every pair is tried
constexpr double kLeastParallax_rad = 0.05;
constexpr int kRefinements = 5;

/// A viewing ray in the world frame.
struct Ray {
  std::int64_t landmark_id;
  Eigen::Vector2d from_m;
  double direction_rad;
  double tolerance_rad;

  double residual_rad(const Eigen::Vector2d& point_m) const {
    const Eigen::Vector2d to = point_m - from_m;
    return wrap(direction_rad - std::atan2(to.y(), to.x()));
  }
  bool points_at(const Eigen::Vector2d& point_m) const { return std::abs(residual_rad(point_m)) <= tolerance_rad; }
};

std::vector<Ray> rays_of(std::span<const SightingRecord> sightings, std::span<const StampedPose> truth,
                         const Eigen::Vector2d& p_body_camera_m) {
  std::vector<Ray> rays;
  for (const SightingRecord& sighting : sightings)
    if (const auto pose = pose_at(truth, sighting.stamp); pose && std::isfinite(pose->heading_rad))
      rays.push_back({sighting.landmark_id, *pose * p_body_camera_m, wrap(pose->heading_rad + sighting.azimuth_rad),
                      4.0 * sighting.sigma_rad + kSightingTolerance_rad});
  std::ranges::stable_sort(rays, std::less{}, &Ray::landmark_id);
  return rays;
}

/// The intersection of two rays. Nothing if it is behind either ray or if the parallax is too small.
std::optional<Eigen::Vector2d> meeting(const Ray& a, const Ray& b) {
  const Eigen::Vector2d u(std::cos(a.direction_rad), std::sin(a.direction_rad));
  const Eigen::Vector2d v(std::cos(b.direction_rad), std::sin(b.direction_rad));
  const auto cross = [](const Eigen::Vector2d& x, const Eigen::Vector2d& y) { return x.x() * y.y() - x.y() * y.x(); };
  const double sine = cross(u, v);
  if (std::abs(sine) < std::sin(kLeastParallax_rad)) return std::nullopt;
  const Eigen::Vector2d apart = b.from_m - a.from_m;
  const double along_a = cross(apart, v) / sine, along_b = cross(apart, u) / sine;
  if (along_a <= 0.0 || along_b <= 0.0) return std::nullopt;
  return a.from_m + along_a * u;
}

std::size_t agreeing(std::span<const Ray> rays, const Eigen::Vector2d& point_m) {
  return static_cast<std::size_t>(std::ranges::count_if(rays, [&](const Ray& ray) { return ray.points_at(point_m); }));
}

/// The intersection of two rays that most rays aim at. If there are many rays, only a selection forms pairs.
std::optional<Eigen::Vector2d> consensus(std::span<const Ray> rays) {
  const std::size_t step = (rays.size() + kMostHypotheses - 1) / kMostHypotheses;
  std::optional<Eigen::Vector2d> best;
  std::size_t most = 0;
  for (std::size_t i = 0; i < rays.size(); i += step)
    for (std::size_t j = i + step; j < rays.size(); j += step) {
      const auto point = meeting(rays[i], rays[j]);
      if (!point) continue;
      const std::size_t count = agreeing(rays, *point);
      if (count <= most) continue;
      most = count;
      best = point;
    }
  return best;
}

/// The least-squares intersection of the rays that aim at `point_m`.
Eigen::Vector2d refined(std::span<const Ray> rays, Eigen::Vector2d point_m) {
  for (int k = 0; k < kRefinements; ++k) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
    for (const Ray& ray : rays) {
      if (!ray.points_at(point_m)) continue;
      const Eigen::Vector2d to = point_m - ray.from_m;
      const Eigen::Vector2d gradient = Eigen::Vector2d(-to.y(), to.x()) / to.squaredNorm();
      const double weight = 1.0 / (ray.tolerance_rad * ray.tolerance_rad);
      information += weight * gradient * gradient.transpose();
      pull += weight * gradient * ray.residual_rad(point_m);
    }
    const Eigen::Vector2d step = information.fullPivLu().solve(pull);
    if (!step.allFinite()) break;
    point_m += step;
  }
  return point_m;
}

/// Evaluates the rays of one landmark.
void judge(std::span<const Ray> rays, SightingErrors& errors) {
  if (rays.size() < kFewestSightings) return;
  const auto point = consensus(rays);
  if (!point) return;
  const std::size_t right = std::max(agreeing(rays, *point), agreeing(rays, refined(rays, *point)));
  errors.judged += rays.size();
  errors.wrong += rays.size() - right;
}

}  // namespace

SightingErrors sighting_errors(std::span<const SightingRecord> sightings, std::span<const StampedPose> truth,
                               const Eigen::Vector2d& p_body_camera_m) {
  const std::vector<Ray> rays = rays_of(sightings, truth, p_body_camera_m);
  SightingErrors errors;
  for (std::size_t first = 0; first < rays.size();) {
    std::size_t end = first;
    while (end < rays.size() && rays[end].landmark_id == rays[first].landmark_id) ++end;
    judge(std::span(rays).subspan(first, end - first), errors);
    first = end;
  }
  return errors;
}

}  // namespace azimuth
