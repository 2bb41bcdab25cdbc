#include "slam/perception/colour/class_table.hpp"

#include <algorithm>
#include <cstdlib>

namespace azimuth {
namespace {

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
