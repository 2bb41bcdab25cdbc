#pragma once
#include <cstdint>
#include <vector>

#include "slam/camera/image_mask.hpp"
#include "slam/geometry/index.hpp"
#include "slam/perception/image/plane.hpp"
#include "slam/perception/image/working_image.hpp"

namespace azimuth {

/// The part of a working square that shows the world.
///
/// Thread contract: reentrant; fill() may run for different images at once. Nothing allocates after construction.
class VisibleRegion {
 public:
  VisibleRegion(const WorkingSquare& square, const MaskShape& mask, int width_px, int height_px);

  /// Distance of the pixel nearest to (x, y) from the nearest hidden pixel or edge of the square [px]; 0 if it is
  /// hidden.
  float clearance_px(float x, float y) const;

  /// Gives every hidden pixel the value of the nearest visible pixel, so that the hidden area makes no edge.
  void fill(Plane<std::uint16_t>& image) const;

  /// The columns [first, last) of a row that hold all its visible pixels.
  struct Span {
    int first = 0;
    int last = 0;
  };
  Span span(int row) const { return spans_[as_size(row)]; }
  int side_px() const { return side_px_; }
  bool empty() const { return empty_; }

 private:
  struct Copy {
    std::uint16_t to_x, to_y, from_x, from_y;
  };
  void add_copy(int x, int y, int from);

  int side_px_ = 0;
  bool empty_ = true;
  std::vector<float> clearance_px_;
  std::vector<Copy> copies_;
  std::vector<Span> spans_;
};

}  // namespace azimuth
