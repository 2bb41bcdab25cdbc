#pragma once

namespace azimuth {

/// When an estimate counts as degraded or lost; the same for every estimator.
struct HealthSettings {
  double degraded_after_m = 5.0;  ///< driven without recognising a landmark
  /// Standard deviation of the position; 0: a hundredth of the map's reach, at least 0.5 m.
  double degraded_sigma_m = 0.0;
  double degraded_sigma_heading_rad = 0.2;
  double degraded_centre_px = 5.0;  ///< offset of the image's centre that calls for a calibration; 0: never
  double degraded_tilt_rad = 0.01;  ///< by which the camera leans more than the rig says; 0: never
  double degraded_lag_s = 0.03;     ///< between images and odometry, unknown to the rig; 0: never
  double lost_sigma_m = 0.0;        ///< likewise; 0: a fifth of the map's reach, 5 m to 50 m
  double lost_sigma_heading_rad = 1.0;

  friend bool operator==(const HealthSettings&, const HealthSettings&) = default;
};

}  // namespace azimuth
