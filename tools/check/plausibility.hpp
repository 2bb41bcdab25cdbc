#pragma once
// Checks whether the bearings and odometry of a drive are consistent with the rig, and names the likeliest mistakes.

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

/// The result of the check for one mistake.
struct MistakeVerdict {
  Mistake mistake = Mistake::hand;
  enum class Says : std::uint8_t { fits, wrong, cannot_tell } says = Says::cannot_tell;
  std::string sentence;   ///< text for the user; for `wrong` with the key to change and its value
  double evidence = 0.0;  ///< for `wrong`: ln of the likelihood ratio in favour of the corrected value
};

struct Plausibility {
  std::vector<MistakeVerdict> verdicts;  ///< one for each mistake, in the order of `Mistake`
  Rig rig;                               ///< the rig with all named mistakes corrected
  /// Share of the bearings that fit with the corrected rig. NaN if bad odometry prevented the fit.
  double fitting = std::numeric_limits<double>::quiet_NaN();

  bool anything_wrong() const;
};

/// The check names a mistake if all of these hold: the drive is ten thousand times likelier without the mistake, after
/// Schwarz's criterion charges each adjusted number; the number differs from the rig's by more than four standard
/// deviations; and the mistake matters, because dead reckoning with the rig's value is off by more than a fortieth of
/// the distance driven, or because the number is grossly off. If the number is not grossly off, the standard deviation
/// is the one from spread_of(), by which parts of the drive disagree. Several mistakes are named one after another, the
/// likeliest first (mathematics VI.26).
///
/// The run's truth and surveyed landmarks, if present, only serve to determine the scale of distances and to decide
/// which of two mirrored worlds is the true one. Precondition: the drive has bearing sets. `progress` counts fits: one
/// for each mistake, and the same number again after each named mistake.
Plausibility judge(const Drive& drive, const Run& run, const Rig& rig, const HindsightSettings& settings,
                   const Progress& progress = {});

}  // namespace azimuth
