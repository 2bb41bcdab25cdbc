#pragma once
#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// A slow robot that wanders through a room of 10 m by 8 m with 15 landmarks all alike, seen by a camera of 60 degrees
/// that sees 40 % of what is in view, once in half a second: one or two at a time, and often none. Its odometer is no
/// better than that of a vacuum cleaner. Bearings have names, to judge by. Same seed, same drive.
Run narrow_room(std::uint64_t seed);

}  // namespace azimuth
