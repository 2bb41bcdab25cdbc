#pragma once
// Internal to tools/check: the position error, in metres, that a wrong number in the rig causes.

#include "tools/drive_fit/drive.hpp"
#include "tools/drive_fit/rig_guess.hpp"

namespace azimuth {

/// Dead-reckoning error of the camera, in its own axes, over a stretch of the drive. Bearings have to correct this
/// error again and again; without landmarks in view it accumulates.
struct OffsetCost {
  double off_m = 0.0;     ///< root mean square over stretches that begin at each image
  double driven_m = 0.0;  ///< length of a stretch: 4 m, or half of the drive's length if that is less
  double share() const { return driven_m > 0.0 ? off_m / driven_m : 0.0; }
};

/// The cost of using `said` if `found` is correct. A wrong image centre counts with the bearing errors it causes.
OffsetCost offset_cost(const Drive& drive, const RigGuess& said, const RigGuess& found);

}  // namespace azimuth
