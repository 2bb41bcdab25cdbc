#pragma once
#include <chrono>

namespace azimuth {

/// How often what the next start goes on with is handed to the keeper.
inline constexpr std::chrono::milliseconds kHandOverInterval{250};

}  // namespace azimuth
