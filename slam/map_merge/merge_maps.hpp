#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// The reason why two maps were not merged.
enum class MergeRefusal : std::uint8_t {
  none,          ///< The maps were merged
  looks,         ///< Landmarks of one map are identified by their appearance
  other_names,   ///< Only one map has identities that the sensor reads
  same_origin,   ///< One map was made from the other: common information would count twice
  no_overlap,    ///< The common part is not significant against chance
  several_ways,  ///< The maps fit together in several ways
};

struct MergedMaps {
  MergeRefusal refusal = MergeRefusal::no_overlap;
  MapSnapshot map;                                       ///< In the frame of map a, with its pose and camera
  Pose2 T_a_b;                                           ///< Frame of map b in that of map a
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Covariance of T_a_b: (x [m], y [m], heading [rad])
  std::size_t common = 0;                                ///< Number of landmarks in both maps
  std::size_t added = 0;                                 ///< Number of landmarks only in map b
  /// Number of identities whose landmark is at another place in map b; the landmarks of map a are kept
  std::size_t moved = 0;
  double chi2 = 0.0;        ///< Chi-square of the common landmarks
  std::size_t degrees = 0;  ///< Degrees of freedom of chi2
  double log_odds = 0.0;    ///< Log odds of the overlap against chance
};

/// The reason that forbids a merge of two maps, irrespective of their geometry; `none` if there is none. For a merge of
/// several maps, it must be `none` for each pair.
MergeRefusal why_not_merged(const MapSnapshot& a, const MapSnapshot& b);

/// Finds the pose of map b in map a, both of the same building, by their common landmarks, and adjusts both maps. The
/// mathematics is in docs/mathematics.md, VI.30. The maps must come from independent drives.
///
/// Reentrant. The time grows with the cube of the number of common landmarks. The same maps give the same bits.
MergedMaps merge_maps(const MapSnapshot& a, const MapSnapshot& b);

}  // namespace azimuth
