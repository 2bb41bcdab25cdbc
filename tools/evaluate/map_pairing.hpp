#pragma once
// Which landmark of a map is which true one: a map of two landmarks is not right twice because they stand side by side.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {

/// A landmark and the name that the sensor, or the survey, gives it.
struct NamedPoint {
  Identity identity = kUnknownIdentity;
  Eigen::Vector2d p_m = Eigen::Vector2d::Zero();
  double z_m = kNotMeasured;  ///< above the floor; none of landmarks in the plane
  // What is not known of them; nothing of true ones.
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  double sigma_z_m = 0.0;
};

/// The size of a map is the diagonal of the box round the true landmarks, and this at least.
inline constexpr double kSmallestMap_m = 5.0;
/// A landmark maps a true one when it is within three standard deviations of it, where this part of the map's size is
/// three of what the map as a whole may be bent by, whatever the covariances say,
inline constexpr double kBentShare = 0.02;
/// and never when it is off by more than this part.
inline constexpr double kFarthestShare = 0.1;

struct MapPair {
  std::size_t estimate = 0, truth = 0;
  double error_m = 0.0;
};

/// Every landmark has one true one at most, and every true one has one landmark at most.
struct MapPairing {
  std::vector<MapPair> pairs;  ///< in the order of the landmarks
  std::size_t duplicates = 0;  ///< landmarks of a true one that another has
  std::size_t phantoms = 0;    ///< of none
};

enum class MapSpace : std::uint8_t { plane, space };

/// By place: of all such pairings the one of the least sum of squared errors, where whoever stays alone counts as much
/// as the farthest pair allowed.
MapPairing pair_by_place(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map,
                         MapSpace space);

/// By name, at any distance. What has no name of a true landmark is neither duplicate nor phantom.
MapPairing pair_by_name(std::span<const NamedPoint> map, std::span<const NamedPoint> world, const Pose2& T_world_map);

}  // namespace azimuth
