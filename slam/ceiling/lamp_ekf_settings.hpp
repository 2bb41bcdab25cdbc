#pragma once
// Every parameter of the lamp EKF: unit, and a default that follows from what a hall with lamps is like.

#include "slam/estimator/centre_settings.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/fastslam/lamps_in_view.hpp"

namespace azimuth {

/// Which direction is of which lamp.
struct LampGateSettings {
  double chi2 = 13.8;               ///< of one direction, 2 degrees of freedom
  double joint_probability = 0.99;  ///< joint compatibility of an image, confidence of the chi-square test
  double new_density_per_sr = 0.1;  ///< directions of something unmapped, per steradian and image
  double rival_log_ratio = 2.0;     ///< joint hypotheses this near in log-likelihood are rivals; 0: never

  friend bool operator==(const LampGateSettings&, const LampGateSettings&) = default;
};

/// How far above the camera lamps hang.
struct LampHeightSettings {
  double guess_m = 4.5;
  double sigma_m = 2.0;  ///< half of the interval it is in two times out of three; below the guess
  double least_m = 0.3;  ///< what is found lower is no lamp

  friend bool operator==(const LampHeightSettings&, const LampHeightSettings&) = default;
};

/// A new lamp, not published, until it is known to be one.
struct LampProbationSettings {
  int confirm_after_sightings = 5;
  double confirm_after_m = 0.5;        ///< and not until seen again after so much was driven
  double confirm_nonlinearity = 0.25;  ///< and until its height is known to this share
  double drop_after_m = 3.0;           ///< driven without seeing it again
  int most = 64;                       ///< no more lamps are begun meanwhile

  friend bool operator==(const LampProbationSettings&, const LampProbationSettings&) = default;
};

/// Whether a lamp is there.
struct LampEvidenceSettings {
  double judge_every_m = 0.1;     ///< driven between images that count as misses of what they do not show
  double forget_log_odds = -4.0;  ///< a lamp is taken out below these odds of being there
  double most_log_odds = 12.0;    ///< no lamp is surer than this

  friend bool operator==(const LampEvidenceSettings&, const LampEvidenceSettings&) = default;
};

/// One lamp mapped twice.
struct LampMergingSettings {
  double chi2 = 11.3;    ///< of 3 degrees of freedom: their distance by its covariance; 0: never merged
  int after_misses = 5;  ///< in a row of one while the other was seen

  friend bool operator==(const LampMergingSettings&, const LampMergingSettings&) = default;
};

struct LampEkfSettings {
  // What is seen
  LampsInView view;  ///< where the rig is silent, up to 1.3 rad from the zenith
  LampGateSettings gates;
  int max_directions = 128;  ///< in an image with more only confirmed lamps are looked for, and none is begun

  // How lamps come and go
  LampHeightSettings height;
  LampProbationSettings probation;
  LampEvidenceSettings evidence;
  LampMergingSettings merging;
  double promote_nonlinearity = 0.03;  ///< a share of uncertain height below which a lamp becomes a point
  int max_landmarks = 256;             ///< the map grows no further

  // The filter
  bool invariant_update = true;  ///< heading corrections turn the whole map (right-invariant EKF)
  CentreSettings centre;

  // When it was wrong
  int recover_after_images = 5;  ///< that contradict the map, in a row, the pose is taken to be vaguer; 0: never
  HealthSettings health;

  friend bool operator==(const LampEkfSettings&, const LampEkfSettings&) = default;
};

}  // namespace azimuth
