#pragma once
#include <Eigen/Core>
#include <Eigen/LU>

#include "slam/camera/camera_tilt.hpp"

namespace azimuth {

/// Offset of the image's centre, where the optical axis meets the image, from its place in the rig.
struct CentreOffset {
  Eigen::Vector2d mean_px;
  Eigen::Matrix2d covariance_px2;
};

/// Errors of the camera relative to its rig, as estimated by a filter: the centre's offset [px], and errors of roll and
/// pitch [rad]. Exact components have no variance.
struct CameraErrors {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();  ///< Centre, then tilt
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();

  CentreOffset centre() const { return {mean.head<2>(), covariance.topLeftCorner<2, 2>()}; }
  CameraTilt tilt() const { return {mean(2), mean(3)}; }
  Eigen::Matrix2d tilt_covariance_rad2() const { return covariance.bottomRightCorner<2, 2>(); }
  bool has_tilt() const { return covariance.diagonal().tail<2>().minCoeff() > 0.0; }

  /// The centre's offset given the tilt. Images mainly determine the two in combination, since their effects look
  /// alike.
  CentreOffset centre_given(const Eigen::Vector2d& tilt_rad) const {
    if (!has_tilt()) return centre();
    const Eigen::Matrix2d by_tilt = covariance.topRightCorner<2, 2>() * tilt_covariance_rad2().inverse();
    return {mean.head<2>() + by_tilt * (tilt_rad - mean.tail<2>()),
            covariance.topLeftCorner<2, 2>() - by_tilt * covariance.bottomLeftCorner<2, 2>()};
  }
};

}  // namespace azimuth
