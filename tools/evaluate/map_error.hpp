#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "slam/geometry/pose2.hpp"
#include "tools/evaluate/map_pairing.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {

/// The map judged by place, as pair_by_place() has it in the plane. landmarks = matched + duplicates + phantoms.
struct MapError {
  std::size_t landmarks = 0;  ///< estimated
  std::size_t true_landmarks = 0;
  std::size_t matched = 0;                    ///< pairs of a landmark and a true one
  std::size_t duplicates = 0;                 ///< further landmarks of a true one
  std::size_t phantoms = 0;                   ///< landmarks of none
  ErrorStatistics position_m;                 ///< of the pairs
  double pair_distance_rms_m = kNotMeasured;  ///< of the pairs, see pair_distance_error()
};

/// `T_world_map` is the motion that aligned the poses: a map gets no alignment of its own.
MapError map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map);

/// The map judged by names, which is stricter: an estimate near the wrong landmark does not count as right. Where
/// landmarks stand closer together than the map is wrong, only this tells the truth; MapError flatters there.
struct NamedMapError {
  std::size_t named = 0;       ///< true landmarks that have an estimate of their name
  std::size_t duplicates = 0;  ///< further estimates of a name
  ErrorStatistics position_m;  ///< of the named ones, each against the best estimate of its name; no limit
};
NamedMapError named_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map);

/// The map judged in space: landmarks with a height against true ones with a height (the second paper's measure, SPEC
/// II.10).
struct SpaceMapError {
  std::size_t landmarks = 0, true_landmarks = 0;  ///< with a height
  std::size_t matched = 0;                        ///< as in MapError, in space
  std::size_t duplicates = 0, phantoms = 0;       ///< likewise
  ErrorStatistics position_m;                     ///< of the pairs, in space
  double height_mean_m = kNotMeasured;            ///< of theirs: positive where the map is too high
};
SpaceMapError space_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map);

/// Error of the distances between landmarks, which needs no common frame (the first paper's measure, SPEC I.15).
struct PairDistanceError {
  double sum_squared_m2 = 0.0;
  double rms_m = kNotMeasured;  ///< over all pairs; needs two points
};

/// Points correspond by index.
PairDistanceError pair_distance_error(std::span<const Eigen::Vector2d> estimated,
                                      std::span<const Eigen::Vector2d> truth);

}  // namespace azimuth
