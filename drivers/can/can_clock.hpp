#pragma once
#include <chrono>

#include "drivers/device/clock_duration.hpp"

namespace azimuth {

/// What frames are dated with: CLOCK_MONOTONIC.
using CanClock = DeviceClock;

inline double can_seconds(CanClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace azimuth
