#pragma once
// The forward motion model of mathematics I.3. The odometer reports the motion of the wheels, and the robot performs
// this motion plus noise, so a filter with the true lambdas models the motion exactly. With zero lambdas the odometry
// is exact up to the calibration errors.

#include "sim/world/random.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// Names and meanings are those of rig.toml.
struct OdometerSettings {
  double lambda_distance_m = 2.5e-3;        ///< Variance of distance per metre [m^2/m]
  double lambda_rotation_rad = 1.2120e-3;   ///< Variance of each rotation per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< Variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< Sideways slip, standard deviation after one metre
  // The errors of an uncalibrated odometer: true = scale * raw, and the heading drifts by drift_rad_per_m.
  double scale_distance = 1.0;
  double scale_turn = 1.0;
  double drift_rad_per_m = 0.0;
  double lag_s = 0.0;  ///< The robot is at the pose reported for time t at time t + lag
};

/// The true motion of the robot when its wheels do `control`: the pose at the end in the frame of the start.
Pose2 disturbed(const Control& control, const OdometerSettings& settings, Random& random);

/// The odometer's reading of `control`, before calibration.
Control raw(const Control& control, const OdometerSettings& settings);

}  // namespace azimuth
