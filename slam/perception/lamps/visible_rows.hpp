#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/lamps/bright_runs.hpp"

namespace azimuth {

/// The pixels of an image that are looked at, as runs.
///
/// Thread contract: reentrant.
class VisibleRows {
 public:
  VisibleRows() = default;
  /// `visible`: one byte a pixel, row by row, 0 for those that are not.
  VisibleRows(const std::vector<std::uint8_t>& visible, int width_px, int height_px);

  /// By rows from above, then from left to right.
  std::span<const PixelRun> runs() const { return runs_; }
  std::span<const PixelRun> row(int v) const;

  /// Whether a run of visible pixels has a hidden one, or the image's edge, beside, above or below it.
  bool at_border(const PixelRun& run) const;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  bool covers(int v, int first, int last) const;

  std::vector<PixelRun> runs_;
  std::vector<std::size_t> starts_;  // of each row in runs_, one more at the end
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace azimuth
