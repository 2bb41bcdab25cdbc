#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/camera/image_mask.hpp"
#include "slam/geometry/index.hpp"
#include "slam/perception/colour/colour_run.hpp"

namespace azimuth {

/// The visible part of an image, in samples of `pixels_per_sample` pixels along a side.
///
/// Thread contract: reentrant.
class VisibleArea {
 public:
  /// A sample is visible if all of its pixels are visible.
  VisibleArea(const ImageMask& mask, int width_px, int height_px, int pixels_per_sample);

  /// Sorted by row from above, then from left to right.
  std::span<const VisibleSpan> spans() const { return spans_; }

  /// Whether a sample shows the world; false outside the image.
  bool contains(int column, int row) const {
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return false;
    return visible_[as_size(row) * as_size(width_) + as_size(column)] != 0;
  }

 private:
  int width_, height_;  // samples
  std::vector<std::uint8_t> visible_;
  std::vector<VisibleSpan> spans_;
};

}  // namespace azimuth
