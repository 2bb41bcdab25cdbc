#pragma once
// Every parameter of the bearing-only EKF: SPEC section, unit, and the default that measured best. `paper_preset`
// holds what the paper prints.

#include <numbers>

namespace azimuth {

enum class Initialisation {
  by_rig,    ///< delayed where the camera sees all round and names what it sees, else undelayed
  delayed,   ///< stochastic cloning and the KL test (SPEC I.4, I.8, I.9)
  undelayed  ///< inverse depth from the first bearing on
};

struct EkfSettings {
  Initialisation initialisation = Initialisation::by_rig;

  // Gating (SPEC I.7, I.10)
  double gate_chi2 = 9.0;             ///< individual gate nu^2 / S; 0: none
  double joint_gate_probability = 0.99;  ///< joint compatibility, confidence of the chi-square test; 0: none
  int recover_after_rejections = 5;   ///< consecutive sightings of a landmark rejected before it is re-initialised; 0: never

  // Correlated bearings (SPEC part V)
  double thinning_s = 0.5;            ///< at most one bearing per landmark in this time; 0: use all

  // Delayed initialisation (SPEC I.9)
  double kl_threshold = 0.1;
  int kl_samples = 1000;
  int min_observations = 2;           ///< sightings needed before a landmark is initialised
  bool gate_remaining = true;         ///< gate the measurements applied after an initialisation
  bool best_pair = true;              ///< smallest KL instead of the first pair under the threshold
  int expire_after_clones = 10;       ///< a candidate not seen while this many clones were made is dropped; 0: never
  double min_clone_baseline_m = 0.1;  ///< a bearing nearer than this to its landmark's last one makes no clone
  int max_clones = 60;                ///< oldest candidates give way beyond this

  // Undelayed initialisation
  double inverse_depth_mean_per_m = 0.25;
  double inverse_depth_sigma_per_m = 0.25;
  double promote_linearity = 0.1;     ///< an inverse-depth landmark below this linearity index becomes a point
  int max_iterations = 4;             ///< of the iterated update

  double max_viewing_distance_m = 15.0;  ///< SPEC I.12
  double min_distance_m = 0.05;          ///< bearings of landmarks nearer than this are not used (SPEC I.6)

  bool invariant_update = true;          ///< heading corrections turn the whole map (right-invariant EKF)

  bool estimate_camera_yaw = false;      ///< the camera's yaw offset as a further state
  double sigma_camera_yaw_rad = 0.05;    ///< its initial standard deviation

  friend bool operator==(const EkfSettings&, const EkfSettings&) = default;
};

/// The first paper's printed values (SPEC I.9, I.7): threshold of the coloured or the SIFT experiment by the bearing
/// noise, no gate on re-observations, first pair that passes. Measured to be harmful (SPEC part IV).
EkfSettings paper_preset(double sigma_bearing_rad);

}  // namespace azimuth
