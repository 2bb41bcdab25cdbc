#include "slam/perception/colour/visible_area.hpp"

#include "slam/geometry/index.hpp"

namespace azimuth {

VisibleArea::VisibleArea(const ImageMask& mask, int width_px, int height_px, int pixels_per_sample)
    : width_(width_px / pixels_per_sample), height_(height_px / pixels_per_sample) {
  const std::vector<std::uint8_t> pixels = mask.raster(width_px, height_px);
  const auto all_visible = [&](int column, int row) {
    std::uint8_t all = 255;
    for (int v = row * pixels_per_sample; v < (row + 1) * pixels_per_sample; ++v)
      for (int u = column * pixels_per_sample; u < (column + 1) * pixels_per_sample; ++u)
        all &= pixels[as_size(v) * as_size(width_px) + as_size(u)];
    return all;
  };
  for (int row = 0; row < height_; ++row) {
    bool open = false;
    for (int column = 0; column < width_; ++column) {
      visible_.push_back(all_visible(column, row));
      const bool visible = visible_.back() != 0;
      if (visible && !open) spans_.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(column), 0});
      if (visible) spans_.back().end = static_cast<std::uint16_t>(column + 1);
      open = visible;
    }
  }
}

}  // namespace azimuth
