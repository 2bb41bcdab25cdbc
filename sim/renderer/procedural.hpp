#pragma once
// Procedural textures: the same seed gives the same texels.

#include <cstdint>

#include "sim/renderer/texture.hpp"

namespace azimuth {

/// Square tiles of 0.5 m with grain and stains.
Texture floor_texture(std::uint64_t seed);

/// A painted wall: nearly uniform, with faint blotches.
Texture plaster_texture(std::uint64_t seed);

/// A printed poster: strong edges and corners of all sizes, different for each seed, inside a uniform border.
Texture poster_texture(std::uint64_t seed, double side_m);

}  // namespace azimuth
