#pragma once
// Working images composed of blobs with known positions and sizes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/world/random.hpp"
#include "slam/perception/image/visible_region.hpp"
#include "slam/perception/image/working_image.hpp"

namespace azimuth::test {

struct Blob {
  double x_px = 0.0, y_px = 0.0;
  double sigma_px = 4.0;
  double gray_levels = 80.0;  ///< relative to the surroundings; may be negative
};

/// A mid-grey image with blobs.
inline Plane<std::uint16_t> picture(int side_px, const std::vector<Blob>& blobs) {
  std::vector<double> gray(static_cast<std::size_t>(side_px * side_px), 128.0);
  for (const Blob& blob : blobs) {
    const auto low = [&](double at) { return std::clamp(static_cast<int>(at - 6.0 * blob.sigma_px), 0, side_px); };
    const auto high = [&](double at) { return std::clamp(static_cast<int>(at + 6.0 * blob.sigma_px), 0, side_px); };
    for (int y = low(blob.y_px); y < high(blob.y_px); ++y) {
      for (int x = low(blob.x_px); x < high(blob.x_px); ++x) {
        const double away = std::hypot(x - blob.x_px, y - blob.y_px) / blob.sigma_px;
        gray[static_cast<std::size_t>(y * side_px + x)] += blob.gray_levels * std::exp(-0.5 * away * away);
      }
    }
  }
  Plane<std::uint16_t> image(side_px, side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      image.at(x, y) = static_cast<std::uint16_t>(
          std::lround(256.0 * std::clamp(gray[static_cast<std::size_t>(y * side_px + x)], 0.0, 255.0)));
  return image;
}

/// Blobs of all sizes everywhere.
inline Plane<std::uint16_t> clutter(int side_px, Random& random) {
  std::vector<Blob> blobs;
  for (int i = 0; i < side_px * side_px / 60; ++i)
    blobs.push_back({random.uniform(0.0, side_px), random.uniform(0.0, side_px), random.uniform(1.2, 6.0),
                     random.uniform(-90.0, 90.0)});
  return picture(side_px, blobs);
}

inline Plane<std::uint16_t> noise(int side_px, Random& random) {
  Plane<std::uint16_t> image(side_px, side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x) image.at(x, y) = static_cast<std::uint16_t>(random.uniform(0.0, 65280.0));
  return image;
}

/// A visible region that covers the whole square.
inline VisibleRegion whole_region(int side_px) {
  const double middle = 0.5 * (side_px - 1);
  const ImageAxes axes{{middle, middle}, 1.0, -1, 0.0};
  return {working_square(axes, 0.5 * side_px, 0), {}, side_px, side_px};
}

}  // namespace azimuth::test
