#pragma once
#include "slam/smoother/robust_kernel.hpp"

namespace azimuth {

/// What is found out beside poses and landmarks: standard deviations of what is known of each before, all of which are
/// expected to be zero; 0: it is exactly that, and no unknown.
struct CalibrationPriors {
  double sigma_scale_distance = 0.0;   ///< relative error of distances
  double sigma_scale_turn = 0.0;       ///< relative error of turns
  double sigma_drift_rad_per_m = 0.0;  ///< heading gained for each metre driven
  double sigma_camera_yaw_rad = 0.0;   ///< how far the camera is turned to the left
  double sigma_lag_s = 0.0;            ///< the robot is at the end of a motion so much later than was said
  double sigma_lag_growth = 0.0;       ///< how much that grows in a second
  double sigma_centre_px = 0.0;        ///< of an image, along each axis
  double sigma_camera_m = 0.0;         ///< how far the camera is from where it was said to stand, along each axis
  friend bool operator==(const CalibrationPriors&, const CalibrationPriors&) = default;
};

/// How landmarks, bearings and the solution are treated. What the motion's noise is, its covariance says.
struct SmootherSettings {
  // A landmark, when it is seen first (SPEC VI.18)
  double inverse_depth_mean_per_m = 0.35;
  double inverse_depth_sigma_per_m = 0.25;

  RobustKernel kernel = RobustKernel::cauchy;
  double kernel_width = 3.0;     ///< standard deviations
  double min_distance_m = 0.05;  ///< bearings of landmarks nearer than this say nothing (SPEC I.6)

  /// A landmark's chart goes along with the pose that saw it first when that is moved. Without, hundreds of metres of
  /// path can hardly be turned: a landmark's (alpha, rho) are linear in its place near its chart only.
  bool charts_go_along = false;

  CalibrationPriors calibration;

  // Solution (SPEC VI.19)
  int max_iterations = 4;
  /// It is found when a further step is expected to lower the energy by less than this, in half squared standard
  /// deviations.
  double converged_below = 1e-3;
  /// A term's part of the normal matrix is made anew when its derivatives have changed by more than this share, or its
  /// weight by more than that. Gradients are always of the moment, so what is found does not depend on either.
  double relinearise_beyond = 2e-3;
  double reweigh_beyond = 0.05;

  friend bool operator==(const SmootherSettings&, const SmootherSettings&) = default;
};

}  // namespace azimuth
