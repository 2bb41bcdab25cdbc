#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/camera/camera_model.hpp"

namespace azimuth {

/// The directions that one pixel covers: `middle` plus or minus `half_rad` (azimuth, elevation).
struct DirectionCell {
  Direction middle;
  Eigen::Vector2d half_rad = Eigen::Vector2d::Zero();
};

/// The inverse of a camera as a table (mathematics II.2): for each pixel the least and greatest azimuth and elevation
/// of all directions that project into it. The table is built by projecting directions so close together that no pixel
/// is missed. Azimuths are circular; the pixel at the centre covers all of them.
///
/// The accuracy is one pixel. The table serves for comparison with CameraModel::direction(), which is exact.
///
/// Thread contract: reentrant. Nothing allocates after construction, which takes a fraction of a second.
class DirectionTable {
 public:
  DirectionTable(const CameraModel& camera, int width_px, int height_px);

  /// The cell of the pixel around `pixel`; nullopt outside the image and for pixels into which no direction projects.
  std::optional<DirectionCell> at(const Pixel& pixel) const;

 private:
  struct Extent {
    float azimuth_rad = 0.0F;  // The first azimuth seen; the offsets below are relative to it.
    // Least and greatest azimuth offset; greatest < least means that the pixel has no direction.
    float least_rad = 0.0F, greatest_rad = -1.0F;
    float low_rad = 0.0F, high_rad = 0.0F;  // Least and greatest elevation
  };
  void widen(const Pixel& pixel, const Direction& direction);
  std::optional<std::size_t> index(const Pixel& pixel) const;

  int width_px_, height_px_;
  std::vector<Extent> extents_;
};

}  // namespace azimuth
