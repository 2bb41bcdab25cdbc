#pragma once
#include "slam/smoother/robust_kernel.hpp"

namespace azimuth {

/// Prior standard deviations of the calibration values, which are estimated together with poses and landmarks. Each
/// value is expected to be zero. A standard deviation of 0 means that the value is exactly zero and no unknown.
struct CalibrationPriors {
  double sigma_scale_distance = 0.0;   ///< relative error of distances
  double sigma_scale_turn = 0.0;       ///< relative error of turns
  double sigma_drift_rad_per_m = 0.0;  ///< heading gained per metre driven
  double sigma_camera_yaw_rad = 0.0;   ///< rotation of the camera to the left
  double sigma_lag_s = 0.0;            ///< time by which images are taken earlier than stamped
  double sigma_lag_growth = 0.0;       ///< growth of the lag per second [s/s]
  double sigma_centre_px = 0.0;        ///< error of the image centre, along each axis
  double sigma_camera_m = 0.0;         ///< error of the camera's position on the robot, along each axis
  friend bool operator==(const CalibrationPriors&, const CalibrationPriors&) = default;
};

/// Settings for landmarks, bearings and the solver. The noise of a motion comes with the motion.
struct SmootherSettings {
  // Prior of a new landmark's inverse distance (mathematics VI.18).
  double inverse_depth_mean_per_m = 0.35;
  double inverse_depth_sigma_per_m = 0.25;

  RobustKernel kernel = RobustKernel::cauchy;
  double kernel_width = 3.0;     ///< standard deviations
  double min_distance_m = 0.05;  ///< bearings of landmarks nearer than this are ignored (mathematics I.6)

  /// Whether a landmark's chart origin moves along with the pose that saw the landmark first. A landmark's position is
  /// linear in (alpha, rho) near its chart origin only, so without this option hundreds of metres of path can hardly
  /// turn.
  bool charts_go_along = false;

  CalibrationPriors calibration;

  // Solver (mathematics VI.19).
  int max_iterations = 4;
  /// The solver has converged when a further step is expected to lower the energy (half squared standard deviations) by
  /// less than this.
  double converged_below = 1e-3;
  /// A term of the normal matrix is recomputed when its derivatives have changed by more than `relinearise_beyond`, or
  /// its weight by more than `reweigh_beyond` (both relative). Gradients are always exact, so the solution depends on
  /// neither value.
  double relinearise_beyond = 2e-3;
  double reweigh_beyond = 0.05;

  friend bool operator==(const SmootherSettings&, const SmootherSettings&) = default;
};

}  // namespace azimuth
