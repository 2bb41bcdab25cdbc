#include "slam/camera/image_mask.hpp"

#include <algorithm>
#include <cstddef>

#include "slam/geometry/index.hpp"

namespace azimuth {

namespace {

/// Counts the edges that a ray to the right crosses. An edge includes only one of its ends, so that a corner counts
/// once.
bool inside(const std::vector<Pixel>& corners, const Pixel& point) {
  bool odd = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Pixel& start = corners[i];
    const Pixel& end = corners[(i + 1) % corners.size()];
    if ((start.y() > point.y()) == (end.y() > point.y())) continue;
    const double along = (point.y() - start.y()) / (end.y() - start.y());
    if (point.x() < start.x() + along * (end.x() - start.x())) odd = !odd;
  }
  return odd;
}

}  // namespace

bool ImageMask::visible(const Pixel& pixel) const {
  const double radius_px = axes_.polar(pixel).radius_px;
  if (!(radius_px >= shape_.inner_px && radius_px <= shape_.outer_px)) return false;
  return std::none_of(shape_.hidden.begin(), shape_.hidden.end(),
                      [&](const std::vector<Pixel>& corners) { return inside(corners, pixel); });
}

std::vector<std::uint8_t> ImageMask::raster(int width_px, int height_px) const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(as_size(width_px) * as_size(height_px));
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) bytes.push_back(visible({u, v}) ? 255 : 0);
  }
  return bytes;
}

}  // namespace azimuth
