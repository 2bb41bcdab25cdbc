#pragma once
// Internal to tools/check: where the camera's clock may have jumped.

#include <optional>

#include "tools/drive_fit/short_stretches.hpp"

namespace azimuth {

/// The guess with the jump that short stretches speak for most: each has a lag of its own that fits it best, and two
/// lags, one before and one after an instant, are to fit all. Nothing: one lag does as well.
std::optional<RigGuess> rough_jump(ShortStretches& stretches, const Drive& drive, const RigGuess& guess);

}  // namespace azimuth
