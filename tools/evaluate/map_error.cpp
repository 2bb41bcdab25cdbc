#include "tools/evaluate/map_error.hpp"

#include <cassert>
#include <cmath>
#include <vector>

namespace azimuth {
namespace {

ErrorStatistics errors_of(const MapPairing& pairing) {
  std::vector<double> errors_m;
  for (const MapPair& pair : pairing.pairs) errors_m.push_back(pair.error_m);
  return error_statistics(errors_m);
}

double pair_distances(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const MapPairing& pairing) {
  std::vector<Eigen::Vector2d> estimated, truth;
  for (const MapPair& pair : pairing.pairs) {
    estimated.push_back(map[pair.estimate].p_m);
    truth.push_back(world[pair.truth].p_m);
  }
  return pair_distance_error(estimated, truth).rms_m;
}

std::vector<NamedPoint> with_heights(std::span<const NamedPoint> points) {
  std::vector<NamedPoint> result;
  for (const NamedPoint& point : points)
    if (point.p_m.allFinite() && std::isfinite(point.z_m)) result.push_back(point);
  return result;
}

}  // namespace

MapError map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map) {
  const MapPairing pairing = pair_by_place(map, world, T_world_map, MapSpace::plane);
  return {.landmarks = map.size(),
          .true_landmarks = world.size(),
          .matched = pairing.pairs.size(),
          .duplicates = pairing.duplicates,
          .phantoms = pairing.phantoms,
          .position_m = errors_of(pairing),
          .pair_distance_rms_m = pair_distances(map, world, pairing)};
}

NamedMapError named_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map) {
  const MapPairing pairing = pair_by_name(map, world, T_world_map);
  return {.named = pairing.pairs.size(), .duplicates = pairing.duplicates, .position_m = errors_of(pairing)};
}

SpaceMapError space_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map) {
  const std::vector<NamedPoint> estimates = with_heights(map);
  // True landmarks without a height get no pair, but count for the size of the map.
  const MapPairing pairing = pair_by_place(estimates, world, T_world_map, MapSpace::space);
  SpaceMapError result{.landmarks = estimates.size(),
                       .true_landmarks = with_heights(world).size(),
                       .matched = pairing.pairs.size(),
                       .duplicates = pairing.duplicates,
                       .phantoms = pairing.phantoms,
                       .position_m = errors_of(pairing)};
  double height_sum_m = 0.0;
  for (const MapPair& pair : pairing.pairs) height_sum_m += estimates[pair.estimate].z_m - world[pair.truth].z_m;
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
