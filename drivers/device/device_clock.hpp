#pragma once
// Times of devices, and their conversion to stamps. Thread contract: reentrant.

#include <chrono>

#include "base/clocks.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The clock by which drivers wait for devices and date their events: CLOCK_MONOTONIC.
using DeviceClock = std::chrono::steady_clock;

// Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`.
inline Stamp stamp_at(DeviceClock::time_point instant, Duration epoch_minus_monotonic = {}) {
  return Stamp{std::chrono::floor<Duration>(instant.time_since_epoch()) + epoch_minus_monotonic};
}
inline DeviceClock::time_point instant_of(Stamp stamp, Duration epoch_minus_monotonic = {}) {
  return DeviceClock::time_point{stamp.time_since_epoch() - epoch_minus_monotonic};
}

}  // namespace azimuth
