#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/lamps/bright_runs.hpp"

namespace azimuth {

/// The pixels of an image that are searched, as runs.
///
/// Thread contract: reentrant.
class VisibleRows {
 public:
  VisibleRows() = default;
  /// `visible` has one byte a pixel, row by row; 0 marks hidden pixels.
  VisibleRows(const std::vector<std::uint8_t>& visible, int width_px, int height_px);

  /// Sorted by row from above, then from left to right.
  std::span<const PixelRun> runs() const { return runs_; }
  std::span<const PixelRun> row(int v) const;

  /// Whether a run of visible pixels touches a hidden pixel or the image's edge on the left, on the right, above or
  /// below.
  bool at_border(const PixelRun& run) const;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  bool covers(int v, int first, int last) const;

  std::vector<PixelRun> runs_;
  std::vector<std::size_t> starts_;  // Of each row: the index of its first run in runs_; and the end index.
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace azimuth
