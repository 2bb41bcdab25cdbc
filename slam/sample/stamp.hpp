#pragma once
// Time stamps of samples. No code under slam/ reads a clock: stamps come from the devices.

#include <chrono>
#include <cmath>
#include <cstdint>

namespace azimuth {

/// The clock of the samples: microseconds since the Unix epoch for live data, since the start of the run in run
/// folders. It has no now().
struct SampleClock {
  using duration = std::chrono::microseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SampleClock>;
  static constexpr bool is_steady = false;
};

using Stamp = SampleClock::time_point;
using Duration = SampleClock::duration;

constexpr Stamp stamp_from_us(std::int64_t microseconds) { return Stamp{Duration{microseconds}}; }
constexpr std::int64_t to_us(Stamp stamp) { return stamp.time_since_epoch().count(); }
constexpr double to_seconds(Duration duration) { return 1e-6 * static_cast<double>(duration.count()); }
constexpr double to_seconds(Stamp stamp) { return to_seconds(stamp.time_since_epoch()); }
/// Rounds to the nearest microsecond. `seconds` must be finite and below 9e12 in magnitude.
inline Duration duration_from_seconds(double seconds) { return Duration{std::llround(seconds * 1e6)}; }

}  // namespace azimuth
