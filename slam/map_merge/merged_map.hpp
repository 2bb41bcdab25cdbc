#pragma once
// Internal to slam/map_merge.

#include "slam/map_merge/joint_fit.hpp"

namespace azimuth {

/// Map a as the fit corrects it, and the landmarks of b that it has not, in its frame. Landmarks of b in `left_out` are
/// forgotten. Pose, camera and numbers are a's.
MapSnapshot merged_map(const MapGaussian& a, const MapGaussian& b, const JointFit& fit,
                       const std::vector<bool>& left_out);

}  // namespace azimuth
