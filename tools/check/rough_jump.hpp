#pragma once
// Internal to tools/check: finds the instant at which the camera's clock may have jumped.

#include <optional>

#include "tools/drive_fit/short_stretches.hpp"

namespace azimuth {

/// The guess with the clock jump that fits short stretches best. The search finds two lags, one before and one after an
/// instant, that minimise the total cost of all stretches. Nothing if one lag fits as well.
std::optional<RigGuess> rough_jump(ShortStretches& stretches, const Drive& drive, const RigGuess& guess);

}  // namespace azimuth
