#pragma once
// A lab whose landmarks have no names, as it is: what stands in its middle hides what stands behind.

#include <cstdint>

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// Leaves out the bearings of landmarks that cannot be seen past `block`, and of those without a name. Landmarks within
/// it are seen from the side that is nearest to them.
void hide_behind(const Rectangle& block, Run& run);

/// coloured_lab() with a block in its middle; about nine bearings an image are left. Names are kept, to judge by.
Run hidden_lab(std::uint64_t seed, int laps = 1);

}  // namespace azimuth
