#pragma once
#include <Eigen/Core>
#include <Eigen/LU>

#include "slam/camera/camera_tilt.hpp"

namespace azimuth {

/// Where the optical axis meets the image, from where it was said to be.
struct CentreOffset {
  Eigen::Vector2d mean_px;
  Eigen::Matrix2d covariance_px2;
};

/// By how much a camera is other than its rig says, as a filter estimates it: the centre's offset [px] and what roll
/// and pitch are more [rad]. What is exact has no variance.
struct CameraErrors {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();  ///< centre, then tilt
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();

  CentreOffset centre() const { return {mean.head<2>(), covariance.topLeftCorner<2, 2>()}; }
  CameraTilt tilt() const { return {mean(2), mean(3)}; }
  Eigen::Matrix2d tilt_covariance_rad2() const { return covariance.bottomRightCorner<2, 2>(); }
  bool has_tilt() const { return covariance.diagonal().tail<2>().minCoeff() > 0.0; }

  /// If the tilt was known to be so: of two that look alike, what images tell of both together.
  CentreOffset centre_given(const Eigen::Vector2d& tilt_rad) const {
    if (!has_tilt()) return centre();
    const Eigen::Matrix2d by_tilt = covariance.topRightCorner<2, 2>() * tilt_covariance_rad2().inverse();
    return {mean.head<2>() + by_tilt * (tilt_rad - mean.tail<2>()),
            covariance.topLeftCorner<2, 2>() - by_tilt * covariance.bottomLeftCorner<2, 2>()};
  }
};

}  // namespace azimuth
