#pragma once
// Internal to slam/map_merge.

#include "slam/map_merge/joint_fit.hpp"

namespace azimuth {

/// Map a as corrected by the fit, plus the landmarks that only b has, in a's frame. Landmarks of b marked in `left_out`
/// are dropped. Pose, camera and ids are those of a.
MapSnapshot merged_map(const MapGaussian& a, const MapGaussian& b, const JointFit& fit,
                       const std::vector<bool>& left_out);

}  // namespace azimuth
