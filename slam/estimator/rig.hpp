#pragma once
// Fixed properties of the robot: the camera's mounting and noise, the odometry's noise and calibration (rig.toml);
// and what an estimator finds out about them.

#include <optional>
#include <string>

#include "slam/camera/camera_rig.hpp"

namespace azimuth {

/// Noise model of mathematics I.3, and the corrections that turn raw readings into unbiased motion.
struct OdometryRig {
  std::string kind = "wheel_pose";  ///< Cumulative poses, the only kind supported
  // Variances grow with the distance driven and the angle turned.
  double lambda_distance_m = 2.5e-3;        ///< Variance of distance per metre [m^2/m]
  double lambda_rotation_rad = 1.2120e-3;   ///< Variance of each rotation per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< Variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< Sideways slip, standard deviation after one metre
  double floor_distance_m = 1e-3;           ///< Standard deviation added to each step in which the robot moved
  /// Standard deviation of the heading added to each step in which the robot moved
  double floor_rotation_rad = 1.745e-3;
  // Calibration: true = scale * raw, plus a heading that turns by drift_rad_per_m per metre driven.
  double scale_distance = 1.0;
  double scale_turn = 1.0;
  double drift_rad_per_m = 0.0;
  // Standard deviations of the two scales, relative. Bearings carry no information on lengths, so the scale of distance
  // stays unknown unless it is measured; real robots are off by 6 to 8 per cent. Bearings do tell the scale of turns.
  double sigma_scale_distance = 0.05;
  double sigma_scale_turn = 0.01;
  double sigma_drift_rad_per_m = 0.002;  ///< Standard deviation of drift_rad_per_m; 0: exact
  double lag_s = 0.0;                    ///< The robot is at the pose reported for time t at time t + lag
  double sigma_lag_s = 0.02;             ///< Standard deviation of lag_s; 0: exact
  double clock_drift = 0.0;              ///< Growth of the lag per second since the first reading
  bool wheels_swapped = false;           ///< Turns are reported with the wrong sign
};

struct Rig {
  FrontEnd front_end = FrontEnd::bearings;
  CameraRig camera;
  OdometryRig odometry;
};

/// What an estimator has found out about the rig it was given, and uses.
struct RigFinding {
  double bearing_noise = 1.0, odometry_noise = 1.0;  ///< Standard deviations relative to the rig's

  struct Value {
    double found = 0.0, sigma = 0.0;  ///< Value and standard deviation, in the units of the rig's key
  };
  // Only the values that the drive contradicts are set.
  std::optional<Value> yaw_offset_rad = {}, scale_turn = {}, drift_rad_per_m = {}, lag_s = {}, camera_ahead_m = {},
                       camera_left_m = {}, roll_rad = {}, pitch_rad = {};

  bool contradicts() const {
    return yaw_offset_rad || scale_turn || drift_rad_per_m || lag_s || camera_ahead_m || camera_left_m || roll_rad ||
           pitch_rad;
  }
};

/// Converts `errors`, found relative to `rig`, to the values that the rig's keys would have. `scale_turn_error` is
/// relative.
RigFinding by_keys(const Rig& rig, RigFinding errors, double scale_turn_error);

}  // namespace azimuth
