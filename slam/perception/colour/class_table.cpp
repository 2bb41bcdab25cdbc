#include "slam/perception/colour/class_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace azimuth {
namespace {

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

constexpr int kStep = 1 << ClassTable::kDropped;  // Number of sample values that share a cell
constexpr int kCells = 1 << ClassTable::kBits;

/// The value that represents a cell.
std::uint8_t middle(int cell) { return static_cast<std::uint8_t>(cell * kStep + kStep / 2); }

/// The least distance from 128 of the sample values in a cell.
int off_neutral(int cell) {
  const int low = cell * kStep, high = low + kStep - 1;
  return std::max({0, low - 128, 128 - high});
}

/// The least chroma that a pixel of this cell can have.
int least_chroma_of(SampleSpace space, int first, int second, int third) {
  if (space == SampleSpace::yuv) return std::max(off_neutral(second), off_neutral(third));
  const auto [low, high] = std::minmax({first, second, third});
  return std::max(0, (high - low) * kStep - (kStep - 1));
}

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

ClassNumber class_of(const ColourSettings& settings, Rgb colour) {
  const Hsv hsv = hsv_of(colour);
  const std::size_t count = std::min(settings.classes.size(), kMostColourClasses);
  for (std::size_t i = 0; i < count; ++i)
    if (fits(settings.classes[i], hsv)) return static_cast<ClassNumber>(i + 1);
  return 0;
}

ClassTable::ClassTable(const ColourSettings& settings, SampleSpace space)
    : space_(space), classes_(std::size_t{kCells} * kCells * kCells) {
  std::size_t cell = 0;
  for (int first = 0; first < kCells; ++first)
    for (int second = 0; second < kCells; ++second)
      for (int third = 0; third < kCells; ++third, ++cell) {
        const std::uint8_t a = middle(first), b = middle(second), c = middle(third);
        const Rgb colour = space == SampleSpace::rgb ? Rgb{a, b, c} : rgb_of_yuv(a, b, c, settings.full_range_yuv);
        classes_[cell] = class_of(settings, colour);
        if (classes_[cell] == 0) continue;
        least_chroma_ =
            static_cast<std::uint8_t>(std::min<int>(least_chroma_, least_chroma_of(space, first, second, third)));
      }
}

}  // namespace azimuth
