#pragma once
// Every parameter of the bearing-only EKF: SPEC section, unit, and the default that measured best. `paper_preset`
// holds what the paper prints.

#include "slam/estimator/centre_settings.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/planar/identity_settings.hpp"

namespace azimuth {

enum class Initialisation {
  by_rig,    ///< delayed where the camera sees all round, names what it sees and the heading is steady; else undelayed
  delayed,   ///< stochastic cloning and the KL test (SPEC I.4, I.8, I.9); without identities undelayed all the same
  undelayed  ///< inverse depth from the first bearing on
};

/// Whether a bearing is believed to be of the mapped landmark it was matched with (SPEC I.7, I.10).
struct BearingGateSettings {
  double chi2 = 9.0;                ///< individual gate nu^2 / S; 0: none
  double joint_probability = 0.99;  ///< joint compatibility, confidence of the chi-square test; 0: none

  friend bool operator==(const BearingGateSettings&, const BearingGateSettings&) = default;
};

/// Finding the pose anew from one image of named landmarks; only where bearings carry identities.
struct RelocationSettings {
  int bearings = 5;                  ///< of mapped points needed, at least 4; 0: never
  double beyond_m = 0.7;             ///< a pose whose standard deviation is above this is vague
  double beyond_rad = 0.2;           ///< likewise its heading's
  double probability = 0.99;         ///< confidence of the chi-square test of the image against the pose found
  double contradiction_chi2 = 30.0;  ///< of 3 degrees of freedom: the poses contradict each other

  friend bool operator==(const RelocationSettings&, const RelocationSettings&) = default;
};

/// Bearings that carry no identities.
struct UnnamedBearingSettings {
  /// Density of bearings of unmapped things; 0: by rig, 4 in a narrow view, else 0.4 where bearings come from images
  /// and 0.16 where not.
  double new_density_per_rad = 0.0;
  /// A joint hypothesis this near in log-likelihood makes its bearings ambiguous; 0: off.
  double rival_log_ratio = 0.0;
  /// Of what bearings from images are of, in the first metres: the likeliest so many are followed side by side until
  /// it is clear (ekf_hypotheses.hpp); 1: only the likeliest of each image. Coloured landmarks only.
  int start_hypotheses = 8;

  friend bool operator==(const UnnamedBearingSettings&, const UnnamedBearingSettings&) = default;
};

/// A landmark that may be clutter, where bearings carry no identities.
struct ProbationSettings {
  /// One seen less often is on probation; 0: by rig, 8 where bearings come from images, else 3. What only looks like a
  /// landmark from here, a print on the wall or a passer-by, is seen a few times; what stands there, all along the way.
  /// Where bearings come from images, nobody hears of it before: it is neither published nor saved.
  int confirm_after_sightings = 0;
  double drop_after_m = 3.0;  ///< driven without seeing it again

  friend bool operator==(const ProbationSettings&, const ProbationSettings&) = default;
};

/// Landmarks of a known kind mapped twice, where bearings carry no names.
struct MergingSettings {
  double within_m = 0.5;  ///< of each other
  double chi2 = 9.21;     ///< of 2 degrees of freedom: their distance by its covariance
  int after_images = 10;  ///< in which only one of them was seen; 0: never merged

  friend bool operator==(const MergingSettings&, const MergingSettings&) = default;
};

/// SPEC I.9.
struct DelayedSettings {
  double kl_threshold = 0.1;  ///< 0: what the paper prints for the noise of the rig's bearings
  int kl_samples = 1000;
  int min_observations = 2;           ///< sightings needed before a landmark is initialised
  bool gate_remaining = true;         ///< gate the measurements applied after an initialisation
  bool best_pair = true;              ///< smallest KL instead of the first pair under the threshold
  int expire_after_clones = 10;       ///< a candidate not seen while this many clones were made is dropped; 0: never
  double min_clone_baseline_m = 0.1;  ///< a bearing nearer than this to its landmark's last one makes no clone
  int max_clones = 60;                ///< oldest candidates give way beyond this

  friend bool operator==(const DelayedSettings&, const DelayedSettings&) = default;
};

struct UndelayedSettings {
  double inverse_depth_mean_per_m = 0.25;
  double inverse_depth_sigma_per_m = 0.25;
  double promote_linearity = 0.1;  ///< an inverse-depth landmark below this linearity index becomes a point

  friend bool operator==(const UndelayedSettings&, const UndelayedSettings&) = default;
};

struct EkfUpdateSettings {
  int max_iterations = 4;                   ///< of the iterated update; 1: the plain EKF
  double iterate_below_heading_rad = 0.05;  ///< no iteration while the heading is less certain than this
  bool invariant = true;                    ///< heading corrections turn the whole map (right-invariant EKF)
  /// Bearings that come from images are charged for what a linear update leaves out of them. The rig's sigma of
  /// ready-made ones has room for it.
  bool charge_curvature = true;
  /// The rig's sigma_... of its odometer and mounting are believed; false: all that is exact.
  bool consider_scales = true;

  friend bool operator==(const EkfUpdateSettings&, const EkfUpdateSettings&) = default;
};

struct CameraYawSettings {
  bool estimate = false;    ///< the camera's yaw offset as a further state
  double sigma_rad = 0.05;  ///< its initial standard deviation

  friend bool operator==(const CameraYawSettings&, const CameraYawSettings&) = default;
};

struct EkfSettings {
  // What is seen
  double max_viewing_distance_m = 15.0;  ///< SPEC I.12
  double min_distance_m = 0.05;          ///< bearings of landmarks nearer than this are not used (SPEC I.6)
  double thinning_s = 0.5;               ///< at most one bearing per landmark in this time (SPEC part V); 0: use all
  BearingGateSettings gates;
  UnnamedBearingSettings unnamed;
  IdentitySettings identity;  ///< features known by their looks

  // How landmarks come and go
  Initialisation initialisation = Initialisation::by_rig;
  DelayedSettings delayed;
  UndelayedSettings undelayed;
  ProbationSettings probation;
  MergingSettings merging;
  int max_landmarks = 2000;  ///< the map grows no further

  // The filter
  EkfUpdateSettings update;
  CameraYawSettings camera_yaw;
  CentreSettings centre;

  // When it was wrong
  int recover_after_rejections = 5;  ///< sightings rejected in a row before landmark or pose is recovered; 0: never
  RelocationSettings relocation;
  RelocalisationSettings relocalisation;  ///< of a robot that is lost
  HealthSettings health;

  friend bool operator==(const EkfSettings&, const EkfSettings&) = default;
};

/// The first paper's printed values (SPEC I.9, I.7): threshold of the coloured or the SIFT experiment by the bearing
/// noise, no gate on re-observations, first pair that passes, never lost. Measured to be harmful (SPEC part IV).
EkfSettings paper_preset();

/// The threshold printed for the coloured (1.5 degrees) and for the SIFT experiment (0.5 degrees), whichever is nearer.
double printed_kl_threshold(double sigma_bearing_rad);

}  // namespace azimuth
