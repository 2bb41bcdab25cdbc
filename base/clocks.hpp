#pragma once
// The clocks of the machine, and conversions between them.
//
// Thread contract: reentrant.

#include <chrono>
#include <ctime>

namespace azimuth {

// Durations of CLOCK_MONOTONIC, the clock for all waiting.
inline std::chrono::steady_clock::duration clock_duration(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}
inline double in_seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Converts the kernel's time format.
inline std::chrono::nanoseconds from_timespec(const timespec& time) {
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// The present time of one of the kernel's clocks.
inline std::chrono::microseconds now_on(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return std::chrono::floor<std::chrono::microseconds>(from_timespec(now));
}

/// The present offset from CLOCK_MONOTONIC to the time since the Unix epoch. A caller that reads it only once gets
/// evenly running stamps, irrespective of changes of the wall clock.
inline std::chrono::microseconds epoch_minus_monotonic() { return now_on(CLOCK_REALTIME) - now_on(CLOCK_MONOTONIC); }

}  // namespace azimuth
