#pragma once
// Every parameter of the lamp EKF, with its unit and its default for a hall with lamps.

#include "slam/estimator/centre_settings.hpp"
#include "slam/fastslam/lamps_in_view.hpp"

namespace azimuth {

/// The data association of directions with lamps.
struct LampGateSettings {
  double chi2 = 13.8;               ///< Gate of one direction, 2 degrees of freedom
  double joint_probability = 0.99;  ///< Confidence of the chi-square test for the joint compatibility of an image
  double new_density_per_sr = 0.1;  ///< Expected directions of unmapped objects per steradian and image
  /// Joint hypotheses that differ by less than this in log-likelihood are ambiguous; 0: never.
  double rival_log_ratio = 2.0;

  friend bool operator==(const LampGateSettings&, const LampGateSettings&) = default;
};

/// Height of the lamps above the camera.
struct LampHeightSettings {
  double guess_m = 4.5;
  double sigma_m = 2.0;  ///< Half-width of the interval that contains two heights out of three; less than guess_m.
  double least_m = 0.3;  ///< Objects below this height are not lamps

  friend bool operator==(const LampHeightSettings&, const LampHeightSettings&) = default;
};

/// The probation of a new lamp, during which it is not published.
struct LampProbationSettings {
  int confirm_after_sightings = 5;
  double confirm_after_m = 0.5;        ///< Least driven distance between the first and the last detection
  double confirm_nonlinearity = 0.25;  ///< Greatest relative uncertainty of the height at confirmation
  double drop_after_m = 3.0;           ///< A lamp is dropped after so much driving without a detection
  int most = 64;                       ///< Greatest number of lamps on probation

  friend bool operator==(const LampProbationSettings&, const LampProbationSettings&) = default;
};

/// Evidence for the existence of a lamp.
struct LampEvidenceSettings {
  double judge_every_m = 0.1;     ///< Driven distance between images whose misses count
  double forget_log_odds = -4.0;  ///< A lamp is deleted below these log odds of its existence
  double most_log_odds = 12.0;    ///< Upper bound on the log odds

  friend bool operator==(const LampEvidenceSettings&, const LampEvidenceSettings&) = default;
};

/// Merging of two landmarks that are the same lamp.
struct LampMergingSettings {
  double chi2 = 11.3;    ///< Gate on the squared distance of the two landmarks, 3 degrees of freedom; 0: never.
  int after_misses = 5;  ///< Consecutive misses of one lamp while the other was detected

  friend bool operator==(const LampMergingSettings&, const LampMergingSettings&) = default;
};

struct LampEkfSettings {
  // Detection
  LampsInView view;  ///< Without a limit in the rig, lamps are in view up to 1.3 rad from the zenith
  LampGateSettings gates;
  /// In an image with more directions, only confirmed lamps are matched and no lamp is initialised
  int max_directions = 128;

  // Life cycle of lamps
  LampHeightSettings height;
  LampProbationSettings probation;
  LampEvidenceSettings evidence;
  LampMergingSettings merging;
  double promote_nonlinearity = 0.03;  ///< Relative uncertainty of the height below which a lamp becomes a 3D point
  int max_landmarks = 256;             ///< Greatest number of landmarks in the map

  // Filter
  bool invariant_update = true;  ///< Whether heading corrections rotate the whole map (right-invariant EKF)
  CentreSettings centre;

  // Recovery from errors
  /// After so many images that contradict the map, the pose's covariance is inflated; 0: never.
  int recover_after_images = 5;

  friend bool operator==(const LampEkfSettings&, const LampEkfSettings&) = default;
};

}  // namespace azimuth
