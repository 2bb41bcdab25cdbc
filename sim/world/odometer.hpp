#pragma once
// The motion model of SPEC I.3 run forwards. The odometer tells what the wheels did; the robot does that plus noise,
// so a filter that knows the lambdas models exactly what happened here. With zero lambdas odometry is perfect, up to
// the calibration errors.

#include "sim/world/random.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// Names and meanings as in rig.toml.
struct OdometerSettings {
  double lambda_distance_m = 2.5e-3;        ///< variance of distance per metre [m^2/m]
  double lambda_rotation_rad = 1.2120e-3;   ///< variance of each rotation per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< sideways slip, standard deviation after one metre
  // What an uncalibrated odometer gets wrong: true = scale * raw, and the heading turns by this per metre.
  double scale_distance = 1.0;
  double scale_turn = 1.0;
  double drift_rad_per_m = 0.0;
  double lag_s = 0.0;  ///< the robot is at the pose reported for time t at time t + lag
};

/// What the robot really does when its wheels do `control`: the pose at the end in the frame of the start.
Pose2 disturbed(const Control& control, const OdometerSettings& settings, Random& random);

/// What the odometer makes of `control`: the control before calibration.
Control raw(const Control& control, const OdometerSettings& settings);

}  // namespace azimuth
