#pragma once
// Rotates an image as if the robot turned on the spot.

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/perception/rendered_images.hpp"

namespace azimuth::test {

/// Weights of four neighbouring pixels at `fraction` beyond the second one: cubic interpolation (Keys).
inline std::array<double, 4> cubic_weights(double fraction) {
  const double t = fraction;
  return {((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0, ((-1.5 * t + 2.0) * t + 0.5) * t,
          (0.5 * t - 0.5) * t * t};
}

/// Grey level at (u, v); places outside the image take the value of the nearest edge.
inline double cubic_at(const Image& image, double u, double v) {
  const double left = std::floor(u), top = std::floor(v);
  const std::array<double, 4> across = cubic_weights(u - left), down = cubic_weights(v - top);
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    const int row = std::clamp(static_cast<int>(top) - 1 + j, 0, image.format.height_px - 1);
    const std::uint8_t* const pixels = image.view().row(row);
    for (int i = 0; i < 4; ++i) {
      const int column = std::clamp(static_cast<int>(left) - 1 + i, 0, image.format.width_px - 1);
      sum += down[static_cast<std::size_t>(j)] * across[static_cast<std::size_t>(i)] * pixels[column];
    }
  }
  return sum;
}

/// A grey image rotated about `centre` by `angle_rad` from u towards v.
inline Image rotated(const Image& image, const Pixel& centre, double angle_rad) {
  Image out = blank(PixelFormat::gray8, image.format.width_px, image.format.height_px);
  const double cos = std::cos(angle_rad), sin = std::sin(angle_rad);
  std::size_t i = 0;
  for (int v = 0; v < image.format.height_px; ++v) {
    for (int u = 0; u < image.format.width_px; ++u) {
      const double x = u - centre.x(), y = v - centre.y();
      const double gray = cubic_at(image, centre.x() + cos * x + sin * y, centre.y() - sin * x + cos * y);
      out.bytes[i++] = static_cast<std::byte>(std::lround(std::clamp(gray, 0.0, 255.0)));
    }
  }
  return out;
}

}  // namespace azimuth::test
