#pragma once
// Internal to tools/check: what a number of the rig that is off costs, in metres.

#include "tools/drive_fit/drive.hpp"
#include "tools/drive_fit/rig_guess.hpp"

namespace azimuth {

/// How far odometry takes the camera elsewhere on a stretch of the drive, as the camera sees it: what bearings have to
/// put right again and again, and nobody does where nothing is seen.
struct OffsetCost {
  double off_m = 0.0;     ///< root of the mean square, over stretches from every image on
  double driven_m = 0.0;  ///< length of such a stretch: 4 m, or half of what was driven where that is less
  double share() const { return driven_m > 0.0 ? off_m / driven_m : 0.0; }
};

/// Of going by `said` where `found` is right. An image's centre counts by what it turns bearings.
OffsetCost offset_cost(const Drive& drive, const RigGuess& said, const RigGuess& found);

}  // namespace azimuth
