#pragma once
// A small car among cones all alike.

#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// Fast figures of eight (1 to 2 m/s) among eight cones, seen by a camera that looks ahead (140 degrees) at 30 Hz, with
/// wheel speed and steering as odometry; about a minute. Some cones are missed in an image, some bearings are of
/// nothing. Names are kept, to judge by; those of nothing have none.
Run cone_drive(std::uint64_t seed);

}  // namespace azimuth
