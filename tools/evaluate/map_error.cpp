#include "tools/evaluate/map_error.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "slam/association/assignment.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// The size of a map is the diagonal of the bounding box of the true landmarks, but at least this.
constexpr double kSmallestMap_m = 5.0;
/// An estimate may belong to a true landmark within three standard deviations. The variance includes a common
/// distortion of the map; three of its standard deviations are this fraction of the map's size.
constexpr double kBentShare = 0.02;
/// An estimate never belongs to a true landmark farther away than this fraction of the map's size.
constexpr double kFarthestShare = 0.1;

struct MapPair {
  std::size_t estimate = 0, truth = 0;
  double error_m = 0.0;
};

/// A one-to-one assignment: each estimate and each true landmark is in at most one pair.
struct MapPairing {
  std::vector<MapPair> pairs;  ///< in the order of the estimated landmarks
  std::size_t duplicates = 0;  ///< unpaired estimates within reach of a true landmark
  std::size_t phantoms = 0;    ///< unpaired estimates within reach of none
};

enum class MapSpace : std::uint8_t { plane, space };

constexpr double kForbidden = std::numeric_limits<double>::infinity();
constexpr double kSigmas = 3.0;

double size_of(std::span<const NamedPoint> world) {
  Eigen::AlignedBox2d box;
  for (const NamedPoint& truth : world)
    if (truth.p_m.allFinite()) box.extend(truth.p_m);
  return box.isEmpty() ? kSmallestMap_m : std::max(kSmallestMap_m, box.diagonal().norm());
}

/// Decides which estimate may belong to which true landmark.
class Gate {
 public:
  Gate(std::span<const NamedPoint> world, const Pose2& T_world_map, MapSpace space)
      : T_world_map_(T_world_map), space_(space), size_m_(size_of(world)) {}

  double farthest_m() const { return kFarthestShare * size_m_; }

  /// Squared distance of the pair; kForbidden if the pair is outside the gate.
  double squared_error_m2(const NamedPoint& estimate, const NamedPoint& truth) const {
    const Eigen::Vector3d error_m = error(estimate, truth);
    const double squared_m2 = error_m.squaredNorm();
    if (!(squared_m2 <= farthest_m() * farthest_m())) return kForbidden;
    const double sigmas2 = error_m.dot(covariance(estimate).inverse() * error_m);
    return sigmas2 <= kSigmas * kSigmas ? squared_m2 : kForbidden;
  }

 private:
  Eigen::Vector3d error(const NamedPoint& estimate, const NamedPoint& truth) const {
    const Eigen::Vector2d flat_m = T_world_map_ * estimate.p_m - truth.p_m;
    return {flat_m.x(), flat_m.y(), space_ == MapSpace::space ? estimate.z_m - truth.z_m : 0.0};
  }

  Eigen::Matrix3d covariance(const NamedPoint& estimate) const {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_world_map_.heading_rad).toRotationMatrix();
    const double bent_m = kBentShare * size_m_ / kSigmas;
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity() * (bent_m * bent_m);
    covariance_m2.topLeftCorner<2, 2>() += R * estimate.covariance_m2 * R.transpose();
    if (space_ == MapSpace::space) covariance_m2(2, 2) += estimate.sigma_z_m * estimate.sigma_z_m;
    return covariance_m2;
  }

  Pose2 T_world_map_;
  MapSpace space_;
  double size_m_;
};

/// Solves the assignment. `squared_m2` has a row for each estimate. An unpaired estimate is a duplicate if a true
/// landmark is within reach, otherwise a phantom.
MapPairing solved(const std::vector<double>& squared_m2, std::size_t rows, std::size_t columns, double alone_m2) {
  MapPairing result;
  if (rows == 0) return result;
  std::vector<int> truth_of;
  Assignment().solve({squared_m2, rows, columns}, std::vector<double>(rows, alone_m2), Objective::minimise, truth_of);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::span<const double> row(squared_m2.data() + i * columns, columns);
    if (truth_of[i] != kUnassigned) {
      result.pairs.push_back({i, as_size(truth_of[i]), std::sqrt(row[as_size(truth_of[i])])});
      continue;
    }
    const bool within_reach = std::ranges::any_of(row, [](double each) { return each < kForbidden; });
    ++(within_reach ? result.duplicates : result.phantoms);
  }
  return result;
}

/// Pairs by position: the assignment with the least sum of squared errors. An unpaired estimate counts with the square
/// of the largest allowed distance.
MapPairing pair_by_place(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map,
                         MapSpace space) {
  const Gate gate(world, T_world_map, space);
  std::vector<double> squared_m2;
  squared_m2.reserve(map.size() * world.size());
  for (const NamedPoint& estimate : map)
    for (const NamedPoint& truth : world) squared_m2.push_back(gate.squared_error_m2(estimate, truth));
  return solved(squared_m2, map.size(), world.size(), gate.farthest_m() * gate.farthest_m());
}

/// Pairs by identity, at any distance. An estimate whose identity no true landmark has counts as neither duplicate nor
/// phantom.
MapPairing pair_by_name(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map) {
  std::vector<double> squared_m2;
  squared_m2.reserve(map.size() * world.size());
  double largest_m2 = 0.0;
  for (const NamedPoint& estimate : map)
    for (const NamedPoint& truth : world) {
      const double error_m2 = (T_world_map * estimate.p_m - truth.p_m).squaredNorm();
      const bool same = estimate.identity == truth.identity && truth.identity != kUnknownIdentity;
      squared_m2.push_back(same && std::isfinite(error_m2) ? error_m2 : kForbidden);
      if (squared_m2.back() < kForbidden) largest_m2 = std::max(largest_m2, error_m2);
    }
  // The cost of an unpaired estimate is so high that any pair of equal identity is preferred.
  MapPairing result = solved(squared_m2, map.size(), world.size(),
                             2.0 * largest_m2 * static_cast<double>(std::max<std::size_t>(world.size(), 1)) + 1.0);
  result.phantoms = 0;
  return result;
}

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
