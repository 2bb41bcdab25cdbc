#pragma once
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "slam/camera/image_axes.hpp"

namespace azimuth {

/// What of an image shows the world: a ring about the optical axis, without some polygons (struts, cables, antennas).
struct MaskShape {
  double inner_px = 0.0;                                      ///< radius hidden by robot and mounting; itself visible
  double outer_px = std::numeric_limits<double>::infinity();  ///< radius of the rim; itself visible
  std::vector<std::vector<Pixel>> hidden;                     ///< corners of each polygon, in either sense of rotation
};

/// Tells visible pixels from hidden ones. A polygon of fewer than three corners hides nothing; one that crosses itself
/// hides what an odd number of its edges surrounds. Of two polygons that share an edge, exactly one hides a point on
/// it.
///
/// Thread contract: reentrant.
class ImageMask {
 public:
  ImageMask(const ImageAxes& axes, MaskShape shape) : axes_(axes), shape_(std::move(shape)) {}

  bool visible(const Pixel& pixel) const;

  /// Row by row, one byte a pixel: 255 visible, 0 hidden, as image processing libraries like it.
  std::vector<std::uint8_t> raster(int width_px, int height_px) const;

 private:
  ImageAxes axes_;
  MaskShape shape_;
};

}  // namespace azimuth
