#pragma once
#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// 300 stops a metre apart along streets at right angles, through 28 m by 24 m with 140 landmarks all alike: seen ahead
/// within 5 m, each time, by sharp bearings (0.2 degrees). The robot slips sideways and its odometer knows turns badly.
/// Much is new late in the drive. Bearings have names, to judge by. Same seed, same drive.
Run street_drive(std::uint64_t seed);

}  // namespace azimuth
