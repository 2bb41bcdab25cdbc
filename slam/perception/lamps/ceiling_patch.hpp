#pragma once
#include <Eigen/Core>
#include <optional>

#include "slam/camera/camera_model.hpp"

namespace azimuth {

/// A spot in the image as a patch of light in a horizontal ceiling. Lengths are in units of the ceiling's height above
/// the camera.
struct CeilingPatch {
  Pixel middle = Pixel::Zero();  ///< the image of the patch's middle
  double length_heights = 0.0;   ///< of a rectangle with the same moments
  double area_heights2 = 0.0;    ///< likewise
};

/// The patch behind a spot with that centroid and covariance of its pixels. Nothing for spots that no ceiling makes:
/// parts of them are not above the horizon, or where the camera does not see.
///
/// The middle of a lamp is not where its image has its centroid, since the nearer part of the lamp is the larger one:
/// for a lamp of 1.2 m, 4 m away, that is a pixel. So the spot is mapped to the ceiling at four points that have its
/// moments, each weighted by the area of ceiling in one pixel there, which is exact to the third order.
///
/// Thread contract: reentrant. Nothing allocates.
std::optional<CeilingPatch> ceiling_patch(const CameraModel& camera, const Pixel& centroid,
                                          const Eigen::Matrix2d& spread_px2);

}  // namespace azimuth
