#pragma once
#include <Eigen/Core>
#include <optional>

#include "slam/camera/camera_model.hpp"

namespace azimuth {

/// An image spot interpreted as a patch of light in a horizontal ceiling. Lengths are in units of the ceiling's height
/// above the camera.
struct CeilingPatch {
  Pixel middle = Pixel::Zero();  ///< the image of the patch's middle
  double length_heights = 0.0;   ///< Length of the rectangle with the same second moments
  double area_heights2 = 0.0;    ///< Area of that rectangle
};

/// Computes the ceiling patch behind a spot with the given centroid and pixel covariance. Returns nullopt if parts of
/// the spot are not above the horizon or lie outside the camera's field of view.
///
/// The image of a lamp's centre differs from the centroid of the lamp's image, because the nearer part of the lamp
/// appears larger: for a lamp of 1.2 m at 4 m distance the difference is one pixel. The spot is therefore mapped to the
/// ceiling at four points with the moments of the spot, each weighted by the ceiling area that one pixel covers there.
/// This is exact to third order.
///
/// Thread contract: reentrant. Nothing allocates.
std::optional<CeilingPatch> ceiling_patch(const CameraModel& camera, const Pixel& centroid,
                                          const Eigen::Matrix2d& spread_px2);

}  // namespace azimuth
