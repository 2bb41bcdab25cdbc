#pragma once
#include <cstddef>
#include <cstdint>

namespace azimuth {

/// A grey image, not owned.
struct GrayView {
  const std::uint8_t* pixels = nullptr;
  std::ptrdiff_t stride = 0;  ///< Bytes from one row to the next
  int width_px = 0;
  int height_px = 0;

  const std::uint8_t* row(int v) const { return pixels + v * stride; }
};

}  // namespace azimuth
