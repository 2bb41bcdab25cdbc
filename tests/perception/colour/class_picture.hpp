#pragma once
// Small pictures of class numbers, which can be converted to runs.

#include <cstdint>
#include <functional>
#include <vector>

#include "slam/perception/colour/scan.hpp"

namespace azimuth::test {

struct ClassPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> classes;

  ClassPicture(int w, int h)
      : width(w), height(h), classes(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  /// The class at (u, v); 0 outside the picture.
  std::uint8_t at(int u, int v) const {
    const bool inside = u >= 0 && v >= 0 && u < width && v < height;
    return inside ? classes[index(u, v)] : std::uint8_t{0};
  }
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  void paint(const std::function<bool(int, int)>& inside) {
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        if (inside(u, v)) classes[index(u, v)] = 1;
  }
  std::vector<ColourRun> runs() const {
    std::vector<ColourRun> runs;
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        if (at(u, v) == 0) continue;
        if (u == 0 || at(u - 1, v) != at(u, v))
          runs.push_back({static_cast<std::uint16_t>(v), static_cast<std::uint16_t>(u), 0, at(u, v)});
        runs.back().end = static_cast<std::uint16_t>(u + 1);
      }
    return runs;
  }
};

}  // namespace azimuth::test
