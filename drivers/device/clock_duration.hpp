#pragma once
#include <chrono>

namespace azimuth {

/// What devices are waited for by: CLOCK_MONOTONIC.
using DeviceClock = std::chrono::steady_clock;

inline DeviceClock::duration clock_duration(double seconds) {
  return std::chrono::duration_cast<DeviceClock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace azimuth
