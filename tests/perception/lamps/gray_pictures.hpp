#pragma once
// Small grey images with drawn shapes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "slam/perception/lamps/lamp_blobs.hpp"
#include "slam/perception/lamps/lamp_finder.hpp"

namespace azimuth::test {

struct GrayPicture {
  int width_px, height_px;
  std::vector<std::uint8_t> pixels;

  GrayPicture(int width, int height, std::uint8_t value = 0)
      : width_px(width),
        height_px(height),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}
  GrayView view() const { return {pixels.data(), width_px, width_px, height_px}; }
  std::uint8_t& at(int u, int v) {
    return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(u)];
  }
  VisibleRows all_visible() const { return {std::vector<std::uint8_t>(pixels.size(), 255), width_px, height_px}; }

  /// Draws the area for which `inside(u, v)` holds, with 8 x 8 samples per pixel, so that outlines are as soft as a
  /// sensor's.
  void draw(const std::function<bool(double, double)>& inside, double value) {
    constexpr int kSamples = 8;
    for (int v = 0; v < height_px; ++v) {
      for (int u = 0; u < width_px; ++u) {
        int count = 0;
        for (int k = 0; k < kSamples * kSamples; ++k)
          count += inside(u - 0.5 + (k % kSamples + 0.5) / kSamples, v - 0.5 + (k / kSamples + 0.5) / kSamples) ? 1 : 0;
        const double share = static_cast<double>(count) / (kSamples * kSamples);
        at(u, v) = static_cast<std::uint8_t>(std::lround(at(u, v) + share * (value - at(u, v))));
      }
    }
  }
  void rectangle(double u, double v, double length, double width, double turn_rad, double value) {
    const double cos = std::cos(turn_rad), sin = std::sin(turn_rad);
    draw(
        [=](double x, double y) {
          return std::abs((x - u) * cos + (y - v) * sin) <= length / 2 &&
                 std::abs((y - v) * cos - (x - u) * sin) <= width / 2;
        },
        value);
  }
};

}  // namespace azimuth::test
