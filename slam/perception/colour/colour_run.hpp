#pragma once
#include <cstdint>

namespace azimuth {

/// Consecutive samples of one row that have the same class.
struct ColourRun {
  std::uint16_t row = 0;
  std::uint16_t begin = 0, end = 0;  ///< Columns; `end` is one past the last.
  std::uint8_t class_number = 0;     ///< From 1

  int length() const { return end - begin; }
  friend bool operator==(const ColourRun&, const ColourRun&) = default;
};

/// Consecutive samples of one row that show the world.
struct VisibleSpan {
  std::uint16_t row = 0;
  std::uint16_t begin = 0, end = 0;
};

}  // namespace azimuth
