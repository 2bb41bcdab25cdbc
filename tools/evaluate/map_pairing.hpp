#pragma once
// Assigns estimated landmarks to true ones, one to one.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// The size of a map is the diagonal of the bounding box of the true landmarks, but at least this.
inline constexpr double kSmallestMap_m = 5.0;
/// An estimate may belong to a true landmark within three standard deviations. The variance includes a common
/// distortion of the map; three of its standard deviations are this fraction of the map's size.
inline constexpr double kBentShare = 0.02;
/// An estimate never belongs to a true landmark farther away than this fraction of the map's size.
inline constexpr double kFarthestShare = 0.1;

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

/// Pairs by position: the assignment with the least sum of squared errors. An unpaired estimate counts with the square
/// of the largest allowed distance.
MapPairing pair_by_place(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map,
                         MapSpace space);

/// Pairs by identity, at any distance. An estimate whose identity no true landmark has counts as neither duplicate nor
/// phantom.
MapPairing pair_by_name(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map);

}  // namespace azimuth
