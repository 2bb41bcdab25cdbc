#pragma once
#include <chrono>

namespace azimuth {

/// What frames are dated with: CLOCK_MONOTONIC.
using CanClock = std::chrono::steady_clock;

inline CanClock::duration can_duration(double seconds) {
  return std::chrono::duration_cast<CanClock::duration>(std::chrono::duration<double>(seconds));
}
inline double can_seconds(CanClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace azimuth
