#pragma once
#include <Eigen/Core>

#include "slam/geometry/motion.hpp"

namespace azimuth {

/// The systematic errors of odometry, in this order: scale of distance, scale of turn, drift, lag, growth of the lag.
inline constexpr int kOdometryCalibrations = 5;
/// the first of these errors: their effect follows from the motion alone
inline constexpr int kMotionCalibrations = 3;

/// d(motion) / d(lag [s], growth of the lag [s/s]). A motion is (x, y, heading) of its end relative to its start.
using ByLag = Eigen::Matrix<double, 3, kOdometryCalibrations - kMotionCalibrations>;

/// The odometry from one pose to the next.
struct OdometryMeasurement {
  Eigen::Vector3d relative = Eigen::Vector3d::Zero();   ///< (x, y, heading) of the end relative to the start
  Eigen::Matrix3d whitening = Eigen::Matrix3d::Zero();  ///< W, with W^T W the information matrix
  /// d(relative) / d(calibration)
  Eigen::Matrix<double, 3, kOdometryCalibrations> by_calibration =
      Eigen::Matrix<double, 3, kOdometryCalibrations>::Zero();

  Eigen::Matrix3d covariance() const;
};

/// `motion.covariance` must be positive definite.
OdometryMeasurement odometry_measurement(const Motion& motion, const ByLag& by_lag = ByLag::Zero());

/// The motion that was measured, without the derivative by the lag. Its length is that of the chord.
Motion motion_of(const OdometryMeasurement& measured);

/// Composes two measurements; `second` begins where `first` ends.
OdometryMeasurement composed(const OdometryMeasurement& first, const OdometryMeasurement& second);

/// d(composed) / d(first), where both are `relative` (x, y, heading).
Eigen::Matrix3d by_first(const Eigen::Vector3d& first, const Eigen::Vector3d& composed);

}  // namespace azimuth
