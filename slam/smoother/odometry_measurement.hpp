#pragma once
#include <Eigen/Core>

#include "slam/geometry/motion.hpp"

namespace azimuth {

/// The errors that odometry may have throughout, in this order: of distance, of turn, drift, lag, and how fast the lag
/// grows.
inline constexpr int kOdometryCalibrations = 5;
inline constexpr int kMotionCalibrations = 3;  ///< of these, such as its motion alone tells

/// What a lag does to a motion, (x, y, heading) of its end as seen from its start: by seconds of lag, and by seconds
/// that it grows in a second.
using ByLag = Eigen::Matrix<double, 3, kOdometryCalibrations - kMotionCalibrations>;

/// What odometry says of the way from one pose to the next.
struct OdometryMeasurement {
  Eigen::Vector3d relative = Eigen::Vector3d::Zero();   ///< (x, y, heading) of the end as seen from the start
  Eigen::Matrix3d whitening = Eigen::Matrix3d::Zero();  ///< W, with W^T W its information
  Eigen::Matrix<double, 3, kOdometryCalibrations> by_calibration =
      Eigen::Matrix<double, 3, kOdometryCalibrations>::Zero();  ///< d(relative) / d(calibration)

  Eigen::Matrix3d covariance() const;
};

/// `motion.covariance` must be positive definite.
OdometryMeasurement odometry_measurement(const Motion& motion, const ByLag& by_lag = ByLag::Zero());

/// Of the way to where `second` ends, which begins where `first` ends.
OdometryMeasurement composed(const OdometryMeasurement& first, const OdometryMeasurement& second);

/// d(composed) / d(first), both (x, y, heading) of `relative`.
Eigen::Matrix3d by_first(const Eigen::Vector3d& first, const Eigen::Vector3d& composed);

}  // namespace azimuth
