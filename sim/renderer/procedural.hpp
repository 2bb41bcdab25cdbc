#pragma once
// Pictures made of nothing but a seed: same seed, same texels.

#include <cstdint>

#include "sim/renderer/texture.hpp"

namespace azimuth {

/// Square tiles of 0.5 m with grain and stains.
Texture floor_texture(std::uint64_t seed);

/// A painted wall: nearly even, with faint blotches.
Texture plaster_texture(std::uint64_t seed);

/// Something printed: strong edges and corners of all sizes, each seed another one, inside an even border.
Texture poster_texture(std::uint64_t seed, double side_m);

}  // namespace azimuth
