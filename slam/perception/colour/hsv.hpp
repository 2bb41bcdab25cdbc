#pragma once
#include <cstdint>

#include "slam/perception/colour/colour_settings.hpp"

namespace azimuth {

struct Rgb {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// A colour in the hexcone model. Saturation and value are in [0, 1].
struct Hsv {
  double hue_deg = 0.0;  ///< In [0, 360): red 0, green 120, blue 240; 0 for greys.
  double saturation = 0.0;
  double value = 0.0;
};

Hsv hsv_of(Rgb colour);

/// Converts BT.601 samples of full range (0 to 255) or of 16 to 235 (luma) and 16 to 240 (chroma). Values outside the
/// RGB range are clamped.
Rgb rgb_of_yuv(std::uint8_t luma, std::uint8_t u, std::uint8_t v, bool full_range);

/// Whether `hue_deg` lies in the interval, ends included. An interval from a larger to a smaller angle passes through
/// 0.
bool hue_between(double hue_deg, double from_deg, double to_deg);

bool fits(const ColourClass& colours, const Hsv& colour);

}  // namespace azimuth
