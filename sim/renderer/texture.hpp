#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/renderer/colour.hpp"

namespace azimuth {

/// A square picture that repeats in both directions, with all its halved sizes (mipmaps).
///
/// Thread contract: reentrant.
class Texture {
 public:
  /// `texels` holds the rows of a square whose side is a power of two.
  Texture(std::vector<PackedColour> texels, double side_m);

  /// The mipmap level for a pixel that covers `footprint_m` of the picture.
  unsigned level(float footprint_m) const {
    const auto texels = static_cast<unsigned>(std::min(footprint_m * texels_per_m_ * 0.75F, 1e6F));
    return std::min(static_cast<unsigned>(std::bit_width(texels)), static_cast<unsigned>(levels_.size()) - 1);
  }

  /// Bilinear interpolation. Coordinates may be up to 1e4 m in either direction.
  PackedColour at(float x_m, float y_m, unsigned level) const {
    const Level& size = levels_[level];
    const unsigned x = floor_of(x_m * size.steps_per_m), y = floor_of(y_m * size.steps_per_m), mask = size.mask;
    const unsigned left = (x >> 8U) & mask, right = (left + 1) & mask;
    const unsigned top = ((y >> 8U) & mask) << size.shift, bottom = (((y >> 8U) + 1) & mask) << size.shift;
    // The weights in 1/256 add up to 256.
    const unsigned part_x = x & 0xFFU, part_y = y & 0xFFU, both = part_x * part_y >> 8U;
    const PackedColour* const texels = size.texels.data();
    return gathered(spread(texels[top | left]) * (256 - part_x - part_y + both) +
                    spread(texels[top | right]) * (part_x - both) + spread(texels[bottom | left]) * (part_y - both) +
                    spread(texels[bottom | right]) * both);
  }

 private:
  struct Level {
    std::vector<PackedColour> texels;
    float steps_per_m = 1.0F;  // 256 steps a texel
    unsigned shift = 0;        // log2 of the side
    unsigned mask = 0;
  };

  /// Rounds down, also below 0. Negative results wrap round, which is right for a repeating picture.
  static unsigned floor_of(float value) {
    const auto whole = static_cast<std::int32_t>(value);
    return static_cast<unsigned>(whole - (value < static_cast<float>(whole) ? 1 : 0));
  }
  /// Moves the channels 16 bits apart, so that one multiplication serves all three.
  static std::uint64_t spread(PackedColour c) { return (c & 0xFF00FFU) | (std::uint64_t{c & 0xFF00U} << 24U); }
  /// Inverse of spread(), for channels multiplied by 256.
  static PackedColour gathered(std::uint64_t wide) {
    return static_cast<PackedColour>((wide >> 8U & 0xFF00FFU) | (wide >> 32U & 0xFF00U));
  }

  std::vector<Level> levels_;  // Each half as large as the previous one
  float side_m_ = 1.0F;
  float texels_per_m_ = 1.0F;
};

// Procedural textures: the same seed gives the same texels.

/// Square tiles of 0.5 m with grain and stains.
Texture floor_texture(std::uint64_t seed);

/// A painted wall: nearly uniform, with faint blotches.
Texture plaster_texture(std::uint64_t seed);

/// A printed poster: strong edges and corners of all sizes, different for each seed, inside a uniform border.
Texture poster_texture(std::uint64_t seed, double side_m);

}  // namespace azimuth
