#include "tools/evaluate/map_error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <vector>

namespace azimuth {
namespace {

std::size_t nearest(const Eigen::Vector2d& point, std::span<const Eigen::Vector2d> points) {
  const auto closer = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), closer) - points.begin());
}

std::size_t count_duplicates(std::span<const Eigen::Vector2d> points, const std::set<std::size_t>& matched) {
  std::size_t duplicates = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (matched.contains(i)) continue;
    duplicates += std::any_of(matched.begin(), matched.end(),
                              [&](std::size_t other) { return (points[i] - points[other]).norm() < kMaxDuplicate_m; });
  }
  return duplicates;
}

/// Those that are numbers and have a height, in the world.
std::vector<Eigen::Vector3d> in_space(std::span<const NamedPoint> points, const Pose2& T_world_points) {
  std::vector<Eigen::Vector3d> result;
  for (const NamedPoint& point : points) {
    const Eigen::Vector2d flat = T_world_points * point.p_m;
    const Eigen::Vector3d p_world(flat.x(), flat.y(), point.z_m);
    if (p_world.allFinite()) result.push_back(p_world);
  }
  return result;
}

}  // namespace

MapError map_error(std::span<const Eigen::Vector2d> p_map_landmarks, std::span<const Eigen::Vector2d> p_world_landmarks,
                   const Pose2& T_world_map) {
  MapError result;
  result.landmarks = p_map_landmarks.size();
  result.true_landmarks = p_world_landmarks.size();
  if (p_map_landmarks.empty()) return result;

  std::vector<Eigen::Vector2d> aligned, matched_estimates, matched_truth;
  for (const Eigen::Vector2d& p_map : p_map_landmarks) aligned.push_back(T_world_map * p_map);
  std::vector<double> errors_m;
  std::set<std::size_t> matched;
  for (const Eigen::Vector2d& p_world : p_world_landmarks) {
    const std::size_t index = nearest(p_world, aligned);
    const double error_m = (aligned[index] - p_world).norm();
    if (!(error_m <= kMaxMatch_m)) continue;
    errors_m.push_back(error_m);
    matched.insert(index);
    matched_estimates.push_back(aligned[index]);
    matched_truth.push_back(p_world);
  }
  result.matched = errors_m.size();
  result.position_m = error_statistics(errors_m);
  result.pair_distance_rms_m = pair_distance_error(matched_estimates, matched_truth).rms_m;
  result.duplicates = count_duplicates(aligned, matched);
  return result;
}

NamedMapError named_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map) {
  NamedMapError result;
  std::vector<double> errors_m;
  for (const NamedPoint& truth : world) {
    if (truth.identity == kUnknownIdentity) continue;
    std::size_t estimates = 0;
    double nearest_m = INFINITY;
    for (const NamedPoint& estimate : map) {
      if (estimate.identity != truth.identity) continue;
      ++estimates;
      nearest_m = std::min(nearest_m, (T_world_map * estimate.p_m - truth.p_m).norm());
    }
    if (estimates == 0) continue;
    errors_m.push_back(nearest_m);
    result.duplicates += estimates - 1;
  }
  result.named = errors_m.size();
  result.position_m = error_statistics(errors_m);
  return result;
}

SpaceMapError space_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map) {
  const std::vector<Eigen::Vector3d> estimates = in_space(map, T_world_map), truth = in_space(world, Pose2{});
  SpaceMapError result;
  result.landmarks = estimates.size();
  result.true_landmarks = truth.size();
  std::vector<double> errors_m;
  double height_sum_m = 0.0;
  for (const Eigen::Vector3d& p_world : truth) {
    const auto closer = [&p_world](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return (a - p_world).squaredNorm() < (b - p_world).squaredNorm();
    };
    const auto nearest = std::ranges::min_element(estimates, closer);
    if (nearest == estimates.end() || !((*nearest - p_world).norm() <= kMaxMatch_m)) continue;
    errors_m.push_back((*nearest - p_world).norm());
    height_sum_m += nearest->z() - p_world.z();
  }
  result.matched = errors_m.size();
  result.position_m = error_statistics(errors_m);
  if (result.matched > 0) result.height_mean_m = height_sum_m / static_cast<double>(result.matched);
  return result;
}

PairDistanceError pair_distance_error(std::span<const Eigen::Vector2d> estimated,
                                      std::span<const Eigen::Vector2d> truth) {
  assert(estimated.size() == truth.size());
  PairDistanceError result;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < estimated.size(); ++i)
    for (std::size_t j = 0; j < i; ++j, ++pairs) {
      const double error_m = (estimated[i] - estimated[j]).norm() - (truth[i] - truth[j]).norm();
      result.sum_squared_m2 += error_m * error_m;
    }
  if (pairs > 0) result.rms_m = std::sqrt(result.sum_squared_m2 / static_cast<double>(pairs));
  return result;
}

}  // namespace azimuth
