#include "slam/perception/image/sample_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

bool visible(const ImageMask& mask, int u, int v) {
  return mask.visible({u, v}) && mask.visible({u + SampleLattice::kSampleWidth_px - 1, v});
}

/// Distance between samples that gives about kMostSamples if the whole image is visible.
int spacing_px(int width_px, int height_px) {
  const double area_px = static_cast<double>(width_px) * height_px;
  return std::max(SampleLattice::kSampleWidth_px,
                  static_cast<int>(std::ceil(std::sqrt(area_px / SampleLattice::kMostSamples))));
}

constexpr std::size_t kNone = ~std::size_t{0};

}  // namespace

SampleLattice::SampleLattice(const ImageMask& mask, int width_px, int height_px) {
  const int spacing = spacing_px(width_px, height_px);
  std::vector<std::size_t> above(as_size(width_px / spacing + 1), kNone);
  for (int v = 0; v < height_px; v += spacing) {
    Row row{.v = v, .first_u = width_px, .end_u = 0, .begin = samples_.size(), .end = 0};
    std::size_t left = kNone;
    for (int u = 0; u + kSampleWidth_px <= width_px; u += spacing) {
      std::size_t& here = above[as_size(u / spacing)];
      const std::size_t index = visible(mask, u, v) ? samples_.size() : kNone;
      if (index != kNone) {
        samples_.push_back({u, left == kNone ? index : left, here == kNone ? index : here});
        row.first_u = std::min(row.first_u, u);
        row.end_u = u + kSampleWidth_px;
      }
      left = here = index;
    }
    row.end = samples_.size();
    if (row.end > row.begin) rows_.push_back(row);
  }
}

}  // namespace azimuth
