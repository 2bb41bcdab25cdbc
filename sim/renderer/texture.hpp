#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/renderer/colour.hpp"

namespace azimuth {

/// A square picture that repeats in both directions, in all its halved sizes.
///
/// Thread contract: reentrant.
class Texture {
 public:
  /// `texels` holds rows of a square whose side is a power of two.
  Texture(std::vector<Colour> texels, double side_m);

  float side_m() const { return side_m_; }

  /// The size for a pixel that covers `footprint_m` of the picture.
  unsigned level(float footprint_m) const {
    const auto texels = static_cast<unsigned>(std::min(footprint_m * texels_per_m_ * 0.75F, 1e6F));
    return std::min(static_cast<unsigned>(std::bit_width(texels)), static_cast<unsigned>(levels_.size()) - 1);
  }

  /// Interpolated between the four nearest texels.
  Colour at(float x_m, float y_m, unsigned level) const {
    const std::vector<Colour>& texels = levels_[level];
    const unsigned shift = log2_side_ - level, mask = (1U << shift) - 1;
    const float scale = texels_per_m_ / static_cast<float>(1U << level) * kFine;
    const auto x = to_fixed(x_m * scale), y = to_fixed(y_m * scale);
    const unsigned left = (x >> 8U) & mask, right = (left + 1) & mask;
    const unsigned top = ((y >> 8U) & mask) << shift, bottom = (((y >> 8U) + 1) & mask) << shift;
    const unsigned part_x = x & 0xFFU, part_y = y & 0xFFU;
    return mix(mix(texels[top | left], texels[top | right], part_x),
               mix(texels[bottom | left], texels[bottom | right], part_x), part_y);
  }

 private:
  static constexpr float kFine = 256.0F;
  /// Rounds down, also below 0; wraps round far away, which a repeating picture does not mind.
  static unsigned to_fixed(float value) { return static_cast<unsigned>(static_cast<std::int64_t>(std::floor(value))); }

  std::vector<std::vector<Colour>> levels_;  // halved each
  unsigned log2_side_ = 0;
  float side_m_ = 1.0F;
  float texels_per_m_ = 1.0F;
};

}  // namespace azimuth
