#pragma once
// Every parameter of the lamp EKF: unit, and a default that follows from what a hall with lamps is like.

#include "slam/estimator/health_settings.hpp"

namespace azimuth {

struct LampEkfSettings {
  // Which direction is of which lamp
  double gate_chi2 = 13.8;               ///< of one direction, 2 degrees of freedom
  double joint_gate_probability = 0.99;  ///< joint compatibility of an image, confidence of the chi-square test
  double new_density_per_sr = 0.1;       ///< directions of something unmapped, per steradian and image
  double rival_log_ratio = 2.0;          ///< joint hypotheses this near in log-likelihood are rivals; 0: never

  // What is in view
  double detection_probability = 0.0;  ///< of a lamp in view, at most 0.95; 0: by rig, else 0.85
  double max_zenith_rad = 0.0;         ///< lamps are seen up to here; 0: by rig, else 1.4
  double inner_margin = 0.1;           ///< share of that angle at its rim in which nothing counts as missed

  // A new lamp
  double height_m = 4.5;               ///< first guess, above the camera
  double height_sigma_m = 2.0;         ///< half of the interval it is in two times out of three; below height_m
  double min_height_m = 0.3;           ///< above the camera; what is found lower is no lamp
  int confirm_after_sightings = 5;     ///< seen less often it is on probation: not published, and soon forgotten
  double confirm_after_m = 0.5;        ///< likewise until seen again after so much was driven
  double confirm_nonlinearity = 0.25;  ///< and until its height is known to this share
  double probation_m = 3.0;            ///< and is taken out when not seen again within this distance driven
  double judge_every_m = 0.1;          ///< driven between images that count as misses of what they do not show
  double forget_log_odds = -4.0;       ///< a lamp is taken out below these odds of being there
  double most_log_odds = 12.0;         ///< no lamp is surer than this
  double promote_nonlinearity = 0.03;  ///< a share of uncertain height below which a lamp becomes a point

  // One lamp mapped twice
  double merge_chi2 = 11.3;    ///< of 3 degrees of freedom: their distance by its covariance; 0: never merged
  int merge_after_misses = 5;  ///< in a row of one while the other was seen

  /// Initial standard deviation of the image's centre along u and along v, a state wherever bearings come from images;
  /// 0: the rig's centre is exact.
  double sigma_camera_centre_px = 10.0;
  /// The map is begun anew from the same images, once, when they have told the image's centre to this standard
  /// deviation (second_start.hpp); 0: never.
  double second_start_centre_px = 1.0;

  bool invariant_update = true;  ///< heading corrections turn the whole map (right-invariant EKF)

  // Contradiction
  int recover_after_images = 5;  ///< that contradict the map, in a row, the pose is taken to be vaguer; 0: never

  int max_landmarks = 256;  ///< the map grows no further
  // Bounds on the work an image makes
  int max_directions = 128;   ///< in an image with more only confirmed lamps are looked for, and none is begun
  int max_on_probation = 64;  ///< lamps; no more are begun meanwhile

  HealthSettings health;

  friend bool operator==(const LampEkfSettings&, const LampEkfSettings&) = default;
};

}  // namespace azimuth
