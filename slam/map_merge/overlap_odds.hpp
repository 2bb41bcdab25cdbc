#pragma once
// Internal to slam/map_merge.

#include "slam/map_merge/joint_fit.hpp"

namespace azimuth {

/// One explanation of what two maps have in common.
struct MapOverlap {
  JointFit fit;
  double log_odds = 0.0;  ///< against two maps that have nothing in common
};

/// Which landmarks are one, near `start`: pairs are taken out and in, each judged given all others, until none changes.
/// Equation (8).
MapOverlap explain(const MapGaussian& a, const MapGaussian& b, const Pose2& start, double tolerance_m);

}  // namespace azimuth
