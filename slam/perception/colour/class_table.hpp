#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/colour/hsv.hpp"

namespace azimuth {

/// Number of a colour class from 1; 0: none.
using ClassNumber = std::uint8_t;

/// The three samples of a pixel as they come from the camera, red, green, blue or luma, U, V.
enum class SampleSpace : std::uint8_t { rgb, yuv };

/// The class of every colour there is, at 6 bits a sample: what takes a hundred operations is looked up in one.
///
/// Thread contract: reentrant. 256 kB.
class ClassTable {
 public:
  static constexpr unsigned kBits = 6, kDropped = 8 - kBits;

  /// The first kMostColourClasses classes count.
  ClassTable(const ColourSettings& settings, SampleSpace space);

  static constexpr std::size_t index(unsigned first, unsigned second, unsigned third) {
    return (first >> kDropped) << (2 * kBits) | (second >> kDropped) << kBits | third >> kDropped;
  }
  ClassNumber at(unsigned first, unsigned second, unsigned third) const {
    return classes_[index(first, second, third)];
  }
  SampleSpace space() const { return space_; }
  const ClassNumber* data() const { return classes_.data(); }

  /// No pixel with less colour than this has a class. Of RGB: largest less smallest sample. Of YUV: the larger distance
  /// of U and V from 128.
  std::uint8_t least_chroma() const { return least_chroma_; }

 private:
  SampleSpace space_;
  std::vector<ClassNumber> classes_;
  std::uint8_t least_chroma_ = 255;
};

/// The class of one colour, without a table.
ClassNumber class_of(const ColourSettings& settings, Rgb colour);

}  // namespace azimuth
