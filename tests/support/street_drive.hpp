#pragma once
#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// 300 stops a metre apart along streets at right angles, in an area of 28 m by 24 m with 140 identical landmarks. The
/// camera looks ahead, with a range of 5 m and sharp bearings (0.2 degrees), and detects every landmark in view. The
/// robot slips sideways and its odometer measures turns badly. Much of the area is new late in the drive. Bearings keep
/// their names, for evaluation. The same seed gives the same drive.
Run street_drive(std::uint64_t seed);

}  // namespace azimuth
