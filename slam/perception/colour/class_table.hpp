#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

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
