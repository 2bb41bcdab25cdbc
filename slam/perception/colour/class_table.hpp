#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/colour/hsv.hpp"

namespace azimuth {

/// Number of a colour class, from 1; 0 denotes no class.
using ClassNumber = std::uint8_t;

/// The meaning of a pixel's three samples as the camera delivers them: red, green, blue, or luma, U, V.
enum class SampleSpace : std::uint8_t { rgb, yuv };

/// Lookup table for the class of every colour, at 6 bits a sample. A lookup replaces about a hundred operations.
///
/// Thread contract: reentrant. The table occupies 256 kB.
class ClassTable {
 public:
  static constexpr unsigned kBits = 6, kDropped = 8 - kBits;

  /// Only the first kMostColourClasses classes are used.
  ClassTable(const ColourSettings& settings, SampleSpace space);

  static constexpr std::size_t index(unsigned first, unsigned second, unsigned third) {
    return (first >> kDropped) << (2 * kBits) | (second >> kDropped) << kBits | third >> kDropped;
  }
  ClassNumber at(unsigned first, unsigned second, unsigned third) const {
    return classes_[index(first, second, third)];
  }
  SampleSpace space() const { return space_; }
  const ClassNumber* data() const { return classes_.data(); }

  /// The least chroma of any pixel that has a class. Chroma in RGB: largest minus smallest sample. Chroma in YUV: the
  /// larger of the distances of U and V from 128.
  std::uint8_t least_chroma() const { return least_chroma_; }

 private:
  SampleSpace space_;
  std::vector<ClassNumber> classes_;
  std::uint8_t least_chroma_ = 255;
};

/// Computes the class of one colour without a table.
ClassNumber class_of(const ColourSettings& settings, Rgb colour);

}  // namespace azimuth
