#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {

/// A landmark with the identity from the sensor or from the survey.
struct NamedPoint {
  Identity identity = kUnknownIdentity;
  Eigen::Vector2d p_m = Eigen::Vector2d::Zero();
  double z_m = kNotMeasured;  ///< height above the floor; not measured for planar landmarks
  // Uncertainty of the position; zero for true landmarks.
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  double sigma_z_m = 0.0;
};

/// Map error with landmarks paired by position in the plane (see pair_by_place() in map_error.cpp).
/// landmarks = matched + duplicates + phantoms.
struct MapError {
  std::size_t landmarks = 0;  ///< estimated landmarks
  std::size_t true_landmarks = 0;
  std::size_t matched = 0;                    ///< pairs of an estimated and a true landmark
  std::size_t duplicates = 0;                 ///< unpaired estimates of a true landmark that has a pair
  std::size_t phantoms = 0;                   ///< estimated landmarks near no true one
  ErrorStatistics position_m;                 ///< position errors of the pairs
  double pair_distance_rms_m = kNotMeasured;  ///< error of distances between paired landmarks: pair_distance_error()
};

/// `T_world_map` is the motion that aligns the poses with the truth. The map gets no alignment of its own.
MapError map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map);

/// Map error with landmarks paired by identity. This measure is stricter than MapError: an estimate near the wrong
/// landmark does not count as correct. If landmarks are closer together than the map error, MapError is too optimistic.
struct NamedMapError {
  std::size_t named = 0;       ///< true landmarks with an estimate of the same identity
  std::size_t duplicates = 0;  ///< further estimates of the same identity
  ErrorStatistics position_m;  ///< errors of the best estimate of each identity, without an upper limit
};
NamedMapError named_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map);

/// Map error in space: estimated landmarks with a height against true landmarks with a height (the measure of Gamallo
/// et al. 2013, mathematics II.10).
struct SpaceMapError {
  std::size_t landmarks = 0, true_landmarks = 0;  ///< landmarks with a height
  std::size_t matched = 0;                        ///< as in MapError, but in space
  std::size_t duplicates = 0, phantoms = 0;       ///< as in MapError, but in space
  ErrorStatistics position_m;                     ///< position errors of the pairs in space
  double height_mean_m = kNotMeasured;            ///< mean height error of the pairs; positive if the map is too high
};
SpaceMapError space_map_error(std::span<const NamedPoint> map, std::span<const NamedPoint> world,
                              const Pose2& T_world_map);

/// Error of the distances between landmarks, which needs no common frame (the measure of Schlegel & Hochdorfer 2008,
/// mathematics I.15).
struct PairDistanceError {
  double sum_squared_m2 = 0.0;
  double rms_m = kNotMeasured;  ///< root mean square over all pairs; not measured for fewer than two points
};

/// Points correspond by index.
PairDistanceError pair_distance_error(std::span<const Eigen::Vector2d> estimated,
                                      std::span<const Eigen::Vector2d> truth);

}  // namespace azimuth
