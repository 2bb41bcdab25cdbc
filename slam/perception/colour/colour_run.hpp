#pragma once
#include <cstdint>

namespace azimuth {

/// Neighbouring samples of one row which have the same class.
struct ColourRun {
  std::uint16_t row = 0;
  std::uint16_t begin = 0, end = 0;  ///< columns, `end` is the first beyond
  std::uint8_t class_number = 0;     ///< from 1

  int length() const { return end - begin; }
  friend bool operator==(const ColourRun&, const ColourRun&) = default;
};

/// Neighbouring samples of one row which show the world.
struct VisibleSpan {
  std::uint16_t row = 0;
  std::uint16_t begin = 0, end = 0;
};

}  // namespace azimuth
