#pragma once
// A lab with nameless landmarks and occlusion: a block in the middle hides the landmarks behind it.

#include <cstdint>

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// Removes bearings of landmarks that `block` hides, and bearings without a name. A landmark within the block stays
/// visible from its nearest side.
void hide_behind(const Rectangle& block, Run& run);

/// coloured_lab() with a block in its middle, which leaves about nine bearings per image. Bearings keep their names,
/// for evaluation.
Run hidden_lab(std::uint64_t seed, int laps = 1);

}  // namespace azimuth
