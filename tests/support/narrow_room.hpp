#pragma once
#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// A slow robot that wanders through a room of 10 m by 8 m with 15 identical landmarks. A camera with a field of view
/// of 60 degrees takes two images per second and detects 40 % of the landmarks in view: one or two at a time, often
/// none. The odometer is as poor as a vacuum cleaner's. Bearings keep their names, for evaluation. The same seed gives
/// the same drive.
Run narrow_room(std::uint64_t seed);

}  // namespace azimuth
