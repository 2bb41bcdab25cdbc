#include "slam/perception/colour/hsv.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

}  // namespace

Hsv hsv_of(Rgb colour) {
  const int red = colour.red, green = colour.green, blue = colour.blue;
  const int most = std::max({red, green, blue}), chroma = most - std::min({red, green, blue});
  if (chroma == 0) return {0.0, 0.0, most / 255.0};
  double sextant = 0.0;
  if (most == red) {
    sextant = static_cast<double>(green - blue) / chroma;
  } else if (most == green) {
    sextant = 2.0 + static_cast<double>(blue - red) / chroma;
  } else {
    sextant = 4.0 + static_cast<double>(red - green) / chroma;
  }
  const double hue_deg = 60.0 * sextant;
  return {hue_deg < 0.0 ? hue_deg + 360.0 : hue_deg, static_cast<double>(chroma) / most, most / 255.0};
}

Rgb rgb_of_yuv(std::uint8_t luma, std::uint8_t u, std::uint8_t v, bool full_range) {
  const double y = full_range ? luma : (luma - 16) * 255.0 / 219.0;
  const double chroma_scale = full_range ? 1.0 : 255.0 / 224.0;
  const double cb = chroma_scale * (u - 128), cr = chroma_scale * (v - 128);
  return {to_byte(y + 1.402 * cr), to_byte(y - 0.344136 * cb - 0.714136 * cr), to_byte(y + 1.772 * cb)};
}

bool hue_between(double hue_deg, double from_deg, double to_deg) {
  if (from_deg <= to_deg) return hue_deg >= from_deg && hue_deg <= to_deg;
  return hue_deg >= from_deg || hue_deg <= to_deg;
}

bool fits(const ColourClass& colours, const Hsv& colour) {
  return hue_between(colour.hue_deg, colours.hue_from_deg, colours.hue_to_deg) &&
         colour.saturation >= colours.saturation_min && colour.saturation <= colours.saturation_max &&
         colour.value >= colours.value_min && colour.value <= colours.value_max;
}

}  // namespace azimuth
