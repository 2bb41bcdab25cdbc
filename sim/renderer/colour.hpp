#pragma once
// Colours of 8 bits a channel, packed so that two channels at a time can be mixed.

#include <algorithm>
#include <array>
#include <cstdint>

namespace azimuth {

/// 0x00BBGGRR.
using PackedColour = std::uint32_t;

constexpr PackedColour colour(unsigned red, unsigned green, unsigned blue) { return red | green << 8U | blue << 16U; }
constexpr unsigned red_of(PackedColour c) { return c & 0xFFU; }
constexpr unsigned green_of(PackedColour c) { return c >> 8U & 0xFFU; }
constexpr unsigned blue_of(PackedColour c) { return c >> 16U & 0xFFU; }

/// 0 .. 256 for 0 .. 1; anything outside is cut off.
inline unsigned fraction256(float fraction) {
  constexpr float kHalf = 0.5F;  // rounds to nearest: never negative here, and std::lround is a call
  return static_cast<unsigned>(std::clamp(fraction, 0.0F, 1.0F) * 256.0F + kHalf);
}

/// The colour `part` / 256 of the way from `a` to `b`.
constexpr PackedColour mix(PackedColour a, PackedColour b, unsigned part) {
  constexpr PackedColour kRedBlue = 0xFF00FF, kGreen = 0x00FF00;
  const unsigned rest = 256 - part;
  const PackedColour red_blue = ((a & kRedBlue) * rest + (b & kRedBlue) * part) >> 8U;
  const PackedColour green = ((a & kGreen) * rest + (b & kGreen) * part) >> 8U;
  return (red_blue & kRedBlue) | (green & kGreen);
}

/// `part` / 256 as bright.
constexpr PackedColour dim(PackedColour c, unsigned part) { return mix(0, c, part); }

/// Luma of BT.601, as cameras give it.
constexpr unsigned luma(PackedColour c) { return (77 * red_of(c) + 150 * green_of(c) + 29 * blue_of(c)) >> 8U; }

}  // namespace azimuth
