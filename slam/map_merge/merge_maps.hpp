#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Why two maps were not merged.
enum class MergeRefusal : std::uint8_t {
  none,          ///< they were
  looks,         ///< landmarks of one are known by their looks
  other_names,   ///< one has names that the sensor sees, the other has none
  same_origin,   ///< one was made from the other: what both know would be counted twice
  no_overlap,    ///< nothing that they have in common is beyond chance
  several_ways,  ///< they fit together in more than one way
};

struct MergedMaps {
  MergeRefusal refusal = MergeRefusal::no_overlap;
  MapSnapshot map;                                       ///< in the frame of the first, with its pose and camera
  Pose2 T_a_b;                                           ///< frame of the second in that of the first
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of T_a_b: (x [m], y [m], heading [rad])
  std::size_t common = 0;                                ///< landmarks that were in both
  std::size_t added = 0;                                 ///< that only the second had
  std::size_t moved = 0;                                 ///< of one name, but elsewhere: the first's are kept
  double chi2 = 0.0;                                     ///< of the landmarks in common
  std::size_t degrees = 0;                               ///< of freedom that it has
  double log_odds = 0.0;                                 ///< of the overlap, against chance
};

/// What forbids to merge two maps before it is asked how they lie; `none`: nothing. Of several maps, it must be none of
/// each two.
MergeRefusal why_not_merged(const MapSnapshot& a, const MapSnapshot& b);

/// Finds how map b lies in map a of the same building, by what they have in common, and adjusts both. Mathematics in
/// docs/mathematics.md, VI.30. The maps must be of drives that know nothing of each other.
///
/// Reentrant. Takes time with the cube of the number of landmarks in common. Same maps, same bits.
MergedMaps merge_maps(const MapSnapshot& a, const MapSnapshot& b);

}  // namespace azimuth
