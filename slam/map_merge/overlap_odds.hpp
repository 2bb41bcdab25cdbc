#pragma once
// Internal to slam/map_merge.

#include "slam/map_merge/joint_fit.hpp"

namespace azimuth {

/// One hypothesis about the common landmarks of two maps.
struct MapOverlap {
  JointFit fit;
  double log_odds = 0.0;  ///< Log odds against two maps without common landmarks
};

/// Finds the common landmarks near `start`: pairs are removed and added, each judged given all others, until no pair
/// changes. Equation (8) of docs/mathematics.md, VI.30.
MapOverlap explain(const MapGaussian& a, const MapGaussian& b, const Pose2& start, double tolerance_m);

}  // namespace azimuth
