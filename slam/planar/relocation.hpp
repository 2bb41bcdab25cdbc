#pragma once
#include <cstddef>

#include "slam/ekf/resection.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

// When to replace the pose by one found from a single image of named landmarks (slam/ekf/resection.hpp). A linear
// update from a pose that is metres off, after a drive without odometry or a slip of the wheels, would distort the map
// instead. Thread contract: reentrant.

/// Whether the pose is too uncertain for linearising bearings, or contradicted: `rejected` of the image's `matched`
/// bearings failed their gates.
bool is_in_doubt(const PoseBelief& belief, std::size_t rejected, std::size_t matched,
                 const RelocationSettings& settings);

/// Whether `found` explains the image of `directions` bearings, no other pose does, and discarding odometry loses
/// little: the belief contradicts `found` or is much less certain than `found`.
bool replaces(const Resection& found, std::size_t directions, const PoseBelief& belief,
              const RelocationSettings& settings);

}  // namespace azimuth
