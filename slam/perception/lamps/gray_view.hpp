#pragma once
#include <cstddef>
#include <cstdint>

namespace azimuth {

/// A grey image that somebody else holds.
struct GrayView {
  const std::uint8_t* pixels = nullptr;
  std::ptrdiff_t stride = 0;  ///< from row to row
  int width_px = 0;
  int height_px = 0;

  const std::uint8_t* row(int v) const { return pixels + v * stride; }
};

}  // namespace azimuth
