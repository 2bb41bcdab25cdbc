#pragma once
#include <chrono>

namespace azimuth {

/// What has to be added to CLOCK_MONOTONIC now for the time since the Unix epoch. Who asks once has stamps that run
/// evenly, whatever becomes of the wall clock.
inline std::chrono::microseconds epoch_minus_monotonic() {
  const auto epoch = std::chrono::system_clock::now().time_since_epoch();
  const auto monotonic = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(epoch - monotonic);
}

}  // namespace azimuth
