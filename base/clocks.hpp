#pragma once
// The clocks of the machine, and what leads from the one to the other.
//
// Thread contract: reentrant.

#include <chrono>
#include <ctime>

namespace azimuth {

// Of CLOCK_MONOTONIC, which is what everything waits by.
inline std::chrono::steady_clock::duration clock_duration(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}
inline double in_seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// As the kernel writes times.
inline std::chrono::nanoseconds from_timespec(const timespec& time) {
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// What one of the kernel's clocks shows now.
inline std::chrono::microseconds now_on(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return std::chrono::floor<std::chrono::microseconds>(from_timespec(now));
}

/// What has to be added to CLOCK_MONOTONIC now for the time since the Unix epoch. Who asks once has stamps that run
/// evenly, whatever becomes of the wall clock.
inline std::chrono::microseconds epoch_minus_monotonic() { return now_on(CLOCK_REALTIME) - now_on(CLOCK_MONOTONIC); }

}  // namespace azimuth
