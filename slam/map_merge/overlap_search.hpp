#pragma once
// Internal to slam/map_merge.

#include <cstddef>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/map_merge/map_gaussian.hpp"

namespace azimuth {

/// T_a_b that pairs of landmarks suggest.
struct SuggestedTransform {
  Pose2 T_a_b;
  std::size_t agreeing = 0;  ///< landmarks of b that land on one of a
};

/// Two landmarks of each map that are equally far apart fix T_a_b; those that bring the most landmarks of b onto
/// landmarks of a come first. Far enough from each other, and not many. The effort is bounded. Same maps, same bits.
std::vector<SuggestedTransform> suggest_transforms(const MapGaussian& a, const MapGaussian& b, double tolerance_m);

/// How near a landmark of b must land to one of a: by what both maps are in doubt of, and less than to its neighbours.
double landing_tolerance_m(const MapGaussian& a, const MapGaussian& b);

/// Landmarks that are each other's nearest, nearer than the tolerance, and may be one by name, kind and height.
std::vector<Correspondence> mutual_pairs(const MapGaussian& a, const MapGaussian& b, const Pose2& T_a_b,
                                         double tolerance_m);

/// How far the landmarks of b lie from each other in the frame of a by the one transform and by the other, at most.
double farthest_m(const MapGaussian& b, const Pose2& one, const Pose2& other);

}  // namespace azimuth
