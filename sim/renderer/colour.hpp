#pragma once
// Colours of 8 bits a channel, packed so that two channels can be mixed at a time.

#include <algorithm>
#include <array>
#include <cstdint>

namespace azimuth {

/// Layout 0x00BBGGRR.
using PackedColour = std::uint32_t;

constexpr PackedColour colour(unsigned red, unsigned green, unsigned blue) { return red | green << 8U | blue << 16U; }
constexpr unsigned red_of(PackedColour c) { return c & 0xFFU; }
constexpr unsigned green_of(PackedColour c) { return c >> 8U & 0xFFU; }
constexpr unsigned blue_of(PackedColour c) { return c >> 16U & 0xFFU; }

/// Maps 0 .. 1 to 0 .. 256; other values are clamped.
inline unsigned fraction256(float fraction) {
  constexpr float kHalf = 0.5F;  // Rounds to nearest: the value is not negative, and std::lround is a function call
  return static_cast<unsigned>(std::clamp(fraction, 0.0F, 1.0F) * 256.0F + kHalf);
}

/// Mixes `part` / 256 of `b` with the rest of `a`.
constexpr PackedColour mix(PackedColour a, PackedColour b, unsigned part) {
  constexpr PackedColour kRedBlue = 0xFF00FF, kGreen = 0x00FF00;
  const unsigned rest = 256 - part;
  const PackedColour red_blue = ((a & kRedBlue) * rest + (b & kRedBlue) * part) >> 8U;
  const PackedColour green = ((a & kGreen) * rest + (b & kGreen) * part) >> 8U;
  return (red_blue & kRedBlue) | (green & kGreen);
}

/// The colour at `part` / 256 of its brightness.
constexpr PackedColour dim(PackedColour c, unsigned part) { return mix(0, c, part); }

/// Luma of BT.601.
constexpr unsigned luma(PackedColour c) { return (77 * red_of(c) + 150 * green_of(c) + 29 * blue_of(c)) >> 8U; }

}  // namespace azimuth
