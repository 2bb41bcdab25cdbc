#pragma once
// A small car among identical cones.

#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// Fast figures of eight (1 to 2 m/s) among eight cones, for about a minute. A camera that looks ahead (140 degrees)
/// takes images at 30 Hz; wheel speed and steering give the odometry. An image misses some cones, and some bearings are
/// clutter. Bearings of cones keep their names, for evaluation; clutter has none.
Run cone_drive(std::uint64_t seed);

}  // namespace azimuth
