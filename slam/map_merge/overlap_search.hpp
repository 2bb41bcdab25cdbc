#pragma once
// Internal to slam/map_merge.

#include <cstddef>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/map_merge/map_gaussian.hpp"

namespace azimuth {

/// A hypothesis of T_a_b from pairs of landmarks.
struct SuggestedTransform {
  Pose2 T_a_b;
  std::size_t agreeing = 0;  ///< Number of landmarks of b that coincide with one of a
};

/// Two landmarks of each map at equal distances determine T_a_b. Returns a limited number of distinct hypotheses; those
/// that map the most landmarks of b onto landmarks of a come first. The effort is bounded. The same maps give the same
/// bits.
std::vector<SuggestedTransform> suggest_transforms(const MapGaussian& a, const MapGaussian& b, double tolerance_m);

/// The distance within which landmarks of b and a coincide: it follows from the uncertainty of both maps and stays
/// below the spacing of landmarks.
double landing_tolerance_m(const MapGaussian& a, const MapGaussian& b);

/// Pairs of mutually nearest landmarks within the tolerance whose identities, kinds and heights permit the pair.
std::vector<Correspondence> mutual_pairs(const MapGaussian& a, const MapGaussian& b, const Pose2& T_a_b,
                                         double tolerance_m);

/// The greatest distance between the two positions that the transforms give a landmark of b in the frame of a.
double farthest_m(const MapGaussian& b, const Pose2& one, const Pose2& other);

}  // namespace azimuth
