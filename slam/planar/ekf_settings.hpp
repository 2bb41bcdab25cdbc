#pragma once
// All parameters of the bearing-only EKF: section of docs/mathematics.md, unit and tuned default. `paper_preset` and
// `paper_identity_preset` hold the values printed in the paper.

#include <cstdint>

#include "slam/estimator/centre_settings.hpp"

namespace azimuth {

/// What must support a match with a landmark that is not in the map yet, besides its descriptor.
enum class FeatureValidation : std::uint8_t {
  geometry,  ///< Every earlier bearing allows the new direction (mathematics I.13)
  patterns,  ///< The neighbouring features match (mathematics I.14)
  combined   ///< Geometry, and patterns too where geometry allows nearly any direction
};

/// How features that have descriptors but no names are told apart (mathematics I.12 to I.14).
struct IdentitySettings {
  FeatureValidation validation = FeatureValidation::geometry;
  /// A feature is matched only with landmarks that may be in its direction. Its rivals in the ratio test are the other
  /// landmarks, which show how similar descriptors are by chance (mathematics VI.37). False: all landmarks are each
  /// other's rivals (paper).
  bool rivals_elsewhere = true;
  double max_ratio = 0.7;             ///< Descriptor distance to the nearest view over that to the nearest rival's view
  double gate_chi2 = 6.63;            ///< Gate nu^2 / S of a match with a mapped landmark (mathematics I.10)
  double pattern_correlation = 0.8;   ///< t_cc: neighbours correlated more strongly than this match
  int pattern_members = 2;            ///< m: number of neighbours that must match
  double combined_sweep_rad = 1.047;  ///< `combined`: an interval wider than this is weak evidence

  // Bearings as given to the filter.
  double min_sigma_rad = 0.0087;  ///< Lower limit of a bearing's standard deviation
  int independent_bearings = 10;  ///< An image with more recognised features has each one down-weighted; 0: never
  int enough_in_sight = 20;       ///< An image that shows this many mapped landmarks adds none; 0: no limit
  /// Iterations of the filter's update. Iteration finds the mode of the posterior, which is biased when many landmarks
  /// of uncertain distance are seen at once: the map shrinks.
  int max_iterations = 1;
  int min_observations = 3;  ///< Bearings before a landmark is initialised (mathematics part IV)

  // The descriptor store.
  int max_views = 20000;         ///< Limit for all identities together
  int views_per_identity = 6;    ///< Number of views, from different places, per identity
  double view_spacing_m = 0.3;   ///< If two views are from places nearer together than this, only the newer is kept
  int stable_sightings = 3;      ///< An identity seen less often is unstable
  double forget_after_m = 20.0;  ///< An unstable identity is forgotten after driving this far without seeing it

  friend bool operator==(const IdentitySettings&, const IdentitySettings&) = default;
};

/// The paper's values: every image may add landmarks after two bearings, every bearing counts in full, and the
/// descriptors of all images are kept.
IdentitySettings paper_identity_preset();

enum class Initialisation {
  by_rig,  ///< Delayed if the camera sees all round, names landmarks and the heading is steady; else undelayed
  /// Stochastic cloning and the KL test (mathematics I.4, I.8, I.9); undelayed if bearings have no identities
  delayed,
  undelayed  ///< Inverse depth from the first bearing on
};

/// Gates on the association of a bearing with a mapped landmark (mathematics I.7, I.10).
struct BearingGateSettings {
  double chi2 = 9.0;                ///< Individual gate nu^2 / S; 0: none
  double joint_probability = 0.99;  ///< Joint compatibility, confidence of the chi-square test; 0: none

  friend bool operator==(const BearingGateSettings&, const BearingGateSettings&) = default;
};

/// Relocalisation from one image of named landmarks; used only where bearings carry identities.
struct RelocationSettings {
  int bearings = 5;           ///< Number of bearings of mapped points needed, at least 4; 0: never
  double beyond_m = 0.7;      ///< A pose with a larger standard deviation of the position is too uncertain
  double beyond_rad = 0.2;    ///< A pose with a larger standard deviation of the heading is too uncertain
  double probability = 0.99;  ///< Confidence of the chi-square test of the image against the pose found
  /// Squared distance, 3 degrees of freedom, above which two poses contradict each other
  double contradiction_chi2 = 30.0;

  friend bool operator==(const RelocationSettings&, const RelocationSettings&) = default;
};

/// Bearings that carry no identities.
struct UnnamedBearingSettings {
  /// Density of bearings of unmapped landmarks; 0: by rig, 4 in a narrow view, else 0.4 for bearings from images and
  /// 0.16 for others.
  double new_density_per_rad = 0.0;
  /// A joint hypothesis within this log-likelihood of the best makes its bearings ambiguous; 0: off.
  double rival_log_ratio = 0.0;
  /// Number of joint association hypotheses followed in parallel in the first metres (ekf_hypotheses.hpp); 1: only the
  /// most likely one of each image. Coloured landmarks only.
  int start_hypotheses = 8;

  friend bool operator==(const UnnamedBearingSettings&, const UnnamedBearingSettings&) = default;
};

/// Probation of landmarks that may be clutter, where bearings carry no identities.
struct ProbationSettings {
  /// A landmark with fewer bearings is on probation; 0: by rig, 8 for bearings from images, else 3. Clutter, such as a
  /// print on the wall or a passer-by, is seen a few times only; a real landmark is seen all along the way. Landmarks
  /// on probation that come from images are neither published nor saved.
  int confirm_after_sightings = 0;
  double drop_after_m = 3.0;  ///< A landmark unseen for this distance is dropped

  friend bool operator==(const ProbationSettings&, const ProbationSettings&) = default;
};

/// Merging of landmarks of a known kind that were mapped twice, where bearings carry no names.
struct MergingSettings {
  double within_m = 0.5;  ///< Largest distance between the two landmarks
  double chi2 = 9.21;     ///< Gate on the squared distance of the two, 2 degrees of freedom
  int after_images = 10;  ///< Images in which only one of the two was seen; 0: never merged

  friend bool operator==(const MergingSettings&, const MergingSettings&) = default;
};

/// Delayed initialisation (mathematics I.9).
struct DelayedSettings {
  double kl_threshold = 0.1;  ///< 0: the value printed in the paper for the rig's bearing noise
  int kl_samples = 1000;
  int min_observations = 2;           ///< Bearings needed before a landmark is initialised
  bool gate_remaining = true;         ///< Gate the bearings applied after an initialisation
  bool best_pair = true;              ///< Use the pair with the smallest KL, not the first one under the threshold
  int expire_after_clones = 10;       ///< Drop a candidate not seen while this many clones were made; 0: never
  double min_clone_baseline_m = 0.1;  ///< A bearing nearer than this to its landmark's last one makes no clone
  int max_clones = 60;                ///< Beyond this number the oldest clones are dropped

  friend bool operator==(const DelayedSettings&, const DelayedSettings&) = default;
};

struct UndelayedSettings {
  double inverse_depth_mean_per_m = 0.25;
  double inverse_depth_sigma_per_m = 0.25;
  double promote_linearity = 0.1;  ///< An inverse-depth landmark below this linearity index becomes a point

  friend bool operator==(const UndelayedSettings&, const UndelayedSettings&) = default;
};

struct EkfUpdateSettings {
  int max_iterations = 4;                   ///< Iterations of the update; 1: the plain EKF
  double iterate_below_heading_rad = 0.05;  ///< No iteration while the heading's standard deviation is larger
  bool invariant = true;                    ///< Heading corrections turn the whole map (right-invariant EKF)
  /// Charge bearings from images with the terms that a linear update leaves out. The rig's sigma for ready-made
  /// bearings has room for these terms.
  bool charge_curvature = true;
  /// Consider the rig's sigma_... values of odometer and mounting; false: these count as exact.
  bool consider_scales = true;

  friend bool operator==(const EkfUpdateSettings&, const EkfUpdateSettings&) = default;
};

struct CameraYawSettings {
  bool estimate = false;    ///< Estimate the camera's yaw offset as a further state
  double sigma_rad = 0.05;  ///< Initial standard deviation

  friend bool operator==(const CameraYawSettings&, const CameraYawSettings&) = default;
};

struct EkfSettings {
  // Bearings
  double max_viewing_distance_m = 15.0;  ///< mathematics I.12
  double min_distance_m = 0.05;          ///< Bearings of nearer landmarks are not used (mathematics I.6)
  double thinning_s = 0.5;  ///< At most one bearing per landmark in this time (mathematics part V); 0: use all
  BearingGateSettings gates;
  UnnamedBearingSettings unnamed;
  IdentitySettings identity;  ///< Features told apart by descriptors

  // Landmark management
  Initialisation initialisation = Initialisation::by_rig;
  DelayedSettings delayed;
  UndelayedSettings undelayed;
  ProbationSettings probation;
  MergingSettings merging;
  int max_landmarks = 2000;  ///< The map grows no further

  // Filter
  EkfUpdateSettings update;
  CameraYawSettings camera_yaw;
  CentreSettings centre;

  // Failure handling
  int recover_after_rejections = 5;  ///< Consecutive rejections before landmark or pose is re-initialised; 0: never
  RelocationSettings relocation;

  friend bool operator==(const EkfSettings&, const EkfSettings&) = default;
};

/// The paper's printed values (mathematics I.9, I.7): the KL threshold of the coloured or the SIFT experiment by
/// bearing noise, no gate on re-observations, the first pair that passes, never lost. These values are harmful
/// (mathematics part IV).
EkfSettings paper_preset();

/// The threshold printed for the coloured (1.5 degrees) or the SIFT experiment (0.5 degrees), whichever noise is
/// nearer.
double printed_kl_threshold(double sigma_bearing_rad);

}  // namespace azimuth
