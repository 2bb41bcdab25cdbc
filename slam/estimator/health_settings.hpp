#pragma once

namespace azimuth {

/// Thresholds at which an estimate counts as degraded or lost, the same for every estimator.
struct HealthSettings {
  double degraded_after_m = 5.0;  ///< Distance driven without recognising a landmark
  /// Standard deviation of the position at which health is degraded; 0: 1 % of the map's reach, at least 0.5 m.
  double degraded_sigma_m = 0.0;
  double degraded_sigma_heading_rad = 0.2;
  double degraded_centre_px = 5.0;  ///< Offset of the image's centre that calls for a calibration; 0: never
  double degraded_tilt_rad = 0.01;  ///< Camera tilt relative to the rig's; 0: never
  double degraded_lag_s = 0.03;     ///< Lag between images and odometry, relative to the rig's; 0: never
  double lost_sigma_m = 0.0;        ///< Standard deviation of the position; 0: a fifth of the map's reach, 5 m to 50 m
  double lost_sigma_heading_rad = 1.0;

  friend bool operator==(const HealthSettings&, const HealthSettings&) = default;
};

}  // namespace azimuth
