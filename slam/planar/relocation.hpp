#pragma once
#include <cstddef>

#include "slam/ekf/resection.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

// When the pose is found anew from one image of named landmarks (slam/ekf/resection.hpp): a linear update from a pose
// that is metres off, after a drive without odometry or a slip of the wheels, would bend the map to fit it.
// Thread contract: reentrant.

/// Too vague to linearise bearings at, or contradicted: `rejected` of the image's `matched` bearings failed their
/// gates.
bool is_in_doubt(const PoseBelief& belief, std::size_t rejected, std::size_t matched,
                 const RelocationSettings& settings);

/// Whether `found` explains the image of `directions` bearings, nothing else does, and little is lost by forgetting
/// what odometry said: the belief is contradicted by it, or much less certain.
bool replaces(const Resection& found, std::size_t directions, const PoseBelief& belief,
              const RelocationSettings& settings);

}  // namespace azimuth
