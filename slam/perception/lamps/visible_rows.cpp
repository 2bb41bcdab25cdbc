#include "slam/perception/lamps/visible_rows.hpp"

#include <algorithm>

#include "slam/geometry/index.hpp"

namespace azimuth {

VisibleRows::VisibleRows(const std::vector<std::uint8_t>& visible, int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px) {
  const std::uint8_t* pixels = visible.data();
  for (int v = 0; v < height_px; ++v, pixels += width_px) {
    starts_.push_back(runs_.size());
    const std::uint8_t *at = pixels, *const end = pixels + width_px;
    while ((at = std::find_if(at, end, [](std::uint8_t each) { return each != 0; })) != end) {
      const std::uint8_t* const first = at;
      at = std::find(at, end, std::uint8_t{0});
      runs_.push_back({v, static_cast<std::int32_t>(first - pixels), static_cast<std::int32_t>(at - pixels)});
    }
  }
  starts_.push_back(runs_.size());
}

std::span<const PixelRun> VisibleRows::row(int v) const {
  if (v < 0 || v >= height_px_) return {};
  const std::size_t begin = starts_[as_size(v)], end = starts_[as_size(v) + 1];
  return std::span(runs_).subspan(begin, end - begin);
}

bool VisibleRows::covers(int v, int first, int last) const {
  return std::ranges::any_of(row(v), [&](const PixelRun& run) { return run.first <= first && last <= run.last; });
}

bool VisibleRows::at_border(const PixelRun& run) const {
  return !covers(run.row, run.first - 1, run.last + 1) || !covers(run.row - 1, run.first, run.last) ||
         !covers(run.row + 1, run.first, run.last);
}

}  // namespace azimuth
