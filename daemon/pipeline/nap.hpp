#pragma once
#include <chrono>

namespace azimuth {

/// Longest sleep of a stage with nothing to do: it beats at least this often.
inline constexpr std::chrono::milliseconds kNap{100};

}  // namespace azimuth
