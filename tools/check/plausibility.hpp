#pragma once
// Whether bearings and odometry of a drive can be what the rig says, and if not, what is likeliest to be wrong.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "drivers/storage/run.hpp"
#include "tools/check/mistakes.hpp"

namespace azimuth {

/// What came of looking for one of them.
struct MistakeVerdict {
  Mistake mistake = Mistake::hand;
  enum class Says : std::uint8_t { fits, wrong, cannot_tell } says = Says::cannot_tell;
  std::string sentence;   ///< for a person, with the key to change and its value where something is wrong
  double evidence = 0.0;  ///< of `wrong`: ln of how many times likelier the drive is with that value
};

struct Plausibility {
  std::vector<MistakeVerdict> verdicts;  ///< one for each mistake, in their order
  Rig rig;                               ///< with all that is wrong put right
  /// Share of the bearings that fit, with that; NaN: nobody asked them, for odometry is of no use.
  double fitting = std::numeric_limits<double>::quiet_NaN();

  bool anything_wrong() const;
};

/// A mistake is named when the drive is ten thousand times likelier without it, each number that is adjusted charged as
/// by Schwarz's criterion, when the number is four standard deviations from what the rig says, and when it costs: where
/// odometry is right, the camera would be a fortieth of what was driven elsewhere after some metres. A number that is
/// not grossly off must lie as far from the rig's by what the drive's own parts disagree. Several are named one after
/// another, the likeliest first (SPEC VI.26).
///
/// The run's truth and its surveyed landmarks, where it has any, tell the scale of distances and which of two mirrored
/// worlds is the true one, and nothing else. The drive has sets of bearings. `progress` counts fits: one of each
/// mistake, and again once one is named.
Plausibility judge(const Drive& drive, const Run& run, const Rig& rig, const HindsightSettings& settings,
                   const Progress& progress = {});

}  // namespace azimuth
