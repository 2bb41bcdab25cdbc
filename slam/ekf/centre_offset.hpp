#pragma once
#include <Eigen/Core>

namespace azimuth {

/// Where the optical axis meets the image, from where it was said to be, as a filter estimates it.
struct CentreOffset {
  Eigen::Vector2d mean_px;
  Eigen::Matrix2d covariance_px2;
};

}  // namespace azimuth
