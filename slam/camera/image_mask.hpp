#pragma once
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "slam/camera/image_axes.hpp"

namespace azimuth {

/// The part of an image that shows the world: a ring about the optical axis without some polygons (struts, cables,
/// antennas).
struct MaskShape {
  /// Radius of the inner part that robot and mounting hide; a pixel at exactly this radius is visible.
  double inner_px = 0.0;
  /// Radius of the rim; a pixel at exactly this radius is visible.
  double outer_px = std::numeric_limits<double>::infinity();
  /// Corners of each hidden polygon, in either sense of rotation
  std::vector<std::vector<Pixel>> hidden;
};

/// Tells visible pixels from hidden ones. A polygon with fewer than three corners hides nothing; a self-intersecting
/// polygon hides points by the even-odd rule. Of two polygons that share an edge, exactly one hides a point on the
/// edge.
///
/// Thread contract: reentrant.
class ImageMask {
 public:
  ImageMask(const ImageAxes& axes, MaskShape shape) : axes_(axes), shape_(std::move(shape)) {}

  bool visible(const Pixel& pixel) const;

  /// Row by row, one byte a pixel: 255 visible, 0 hidden (the usual mask format of image processing libraries).
  std::vector<std::uint8_t> raster(int width_px, int height_px) const;

 private:
  ImageAxes axes_;
  MaskShape shape_;
};

}  // namespace azimuth
