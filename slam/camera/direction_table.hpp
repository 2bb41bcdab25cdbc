#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/camera/camera_model.hpp"

namespace azimuth {

/// The directions that one pixel covers: from `middle` by `half_rad` (azimuth, elevation) to each side.
struct DirectionCell {
  Direction middle;
  Eigen::Vector2d half_rad = Eigen::Vector2d::Zero();
};

/// The inverse of a camera by a table (SPEC II.2): least and greatest azimuth and elevation of all directions that fall
/// into a pixel, found by sending directions through the camera, so close together that no pixel is missed. Azimuths
/// are circular: the pixel at the centre covers them all.
///
/// As good as a pixel, no better: for comparison with CameraModel::direction(), which is exact.
///
/// Thread contract: reentrant. Nothing allocates after construction, which takes a fraction of a second.
class DirectionTable {
 public:
  DirectionTable(const CameraModel& camera, int width_px, int height_px);

  /// Of the pixel around `pixel`; nothing outside of the image and for pixels into which no direction falls.
  std::optional<DirectionCell> at(const Pixel& pixel) const;

 private:
  struct Extent {
    float azimuth_rad = 0.0F;                      // the first one seen; offsets are from here
    float least_rad = 0.0F, greatest_rad = -1.0F;  // offsets; the greatest below the least: nothing seen
    float low_rad = 0.0F, high_rad = 0.0F;         // elevations
  };
  void widen(const Pixel& pixel, const Direction& direction);
  std::optional<std::size_t> index(const Pixel& pixel) const;

  int width_px_, height_px_;
  std::vector<Extent> extents_;
};

}  // namespace azimuth
