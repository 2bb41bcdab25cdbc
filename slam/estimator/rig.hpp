#pragma once
// What is fixed on the robot: the camera's mounting and noise, the odometry's noise and calibration (rig.toml).

#include <string>

#include "slam/camera/camera_rig.hpp"

namespace azimuth {

/// Noise of SPEC I.3 and the corrections that turn raw readings into unbiased motion.
struct OdometryRig {
  std::string kind = "wheel_pose";  ///< cumulative poses, the only kind there is
  // Variances grow with what was driven.
  double lambda_distance_m = 2.5e-3;        ///< variance of distance per metre [m^2/m]
  double lambda_rotation_rad = 1.2120e-3;   ///< variance of each rotation per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< sideways slip, standard deviation after one metre
  double floor_distance_m = 1e-3;           ///< standard deviation added to each step in which the robot moved
  double floor_rotation_rad = 1.745e-3;     ///< likewise for the heading
  // Calibration: true = scale * raw, and a heading that turns by drift_rad_per_m for each metre driven.
  double scale_distance = 1.0;
  double scale_turn = 1.0;
  double drift_rad_per_m = 0.0;
  // Standard deviations of what is left unknown of the two scales, relative. Bearings know no lengths, so a scale of
  // distance that nobody has measured stays unknown: two recorded robots' were off by 6 and by 8 per cent. The scale of
  // turns shows on the way.
  double sigma_scale_distance = 0.05;
  double sigma_scale_turn = 0.01;
  double sigma_drift_rad_per_m = 0.002;  ///< standard deviation of drift_rad_per_m; 0: exact
  double lag_s = 0.0;                    ///< the robot is at the pose reported for time t at time t + lag
  double sigma_lag_s = 0.02;             ///< standard deviation of lag_s; 0: exact
  double clock_drift = 0.0;              ///< by how much the lag grows in each second since the first reading
  bool wheels_swapped = false;           ///< turns are reported the other way round
};

struct Rig {
  FrontEnd front_end = FrontEnd::bearings;
  CameraRig camera;
  OdometryRig odometry;
};

}  // namespace azimuth
