#pragma once
// How features that have looks but no names are told apart (SPEC I.12 to I.14): units and the defaults that measured
// best. `paper_identity_preset` holds what the paper prints.

#include <cstdint>

namespace azimuth {

/// What must speak for a match with a landmark that is not in the map yet, beside its looks.
enum class FeatureValidation : std::uint8_t {
  geometry,  ///< every earlier bearing allows this one (SPEC I.13)
  patterns,  ///< the features around it look alike (SPEC I.14)
  combined   ///< geometry, and patterns as well where it allows nearly anything
};

struct IdentitySettings {
  FeatureValidation validation = FeatureValidation::geometry;
  /// Only landmarks that can be where a feature is seen are looked for there, and their rivals are those that cannot:
  /// what these look like tells how alike things are by chance (SPEC VI.37). False: all are each other's rivals
  /// (paper).
  bool rivals_elsewhere = true;
  double max_ratio = 0.7;             ///< distance to the nearest view over that to the nearest rival's
  double gate_chi2 = 6.63;            ///< nu^2 / S of a match with a mapped landmark (SPEC I.10)
  double pattern_correlation = 0.8;   ///< t_cc: above this two neighbours look alike
  int pattern_members = 2;            ///< m: so many neighbours must be found again
  double combined_sweep_rad = 1.047;  ///< combined: a wider interval proves little

  // What the filter is given.
  double min_sigma_rad = 0.0087;  ///< no bearing is believed to be better than this
  int independent_bearings = 10;  ///< in an image with more recognised features each counts for less; 0: never
  int enough_in_sight = 20;       ///< an image that shows so many mapped landmarks adds none; 0: all do
  /// Of the filter's update. The mode of the posterior, which iteration finds, is biased where many landmarks of unsure
  /// distance are seen at once: the map shrinks.
  int max_iterations = 1;
  int min_observations = 3;  ///< sightings before a landmark is initialised (SPEC part IV)

  // The store of looks.
  int max_views = 20000;         ///< of all identities together
  int views_per_identity = 6;    ///< from different places
  double view_spacing_m = 0.3;   ///< of views from places nearer together only the newest is kept
  int stable_sightings = 3;      ///< an identity seen less often is unstable
  double forget_after_m = 20.0;  ///< driven since an unstable identity was last seen, until it is forgotten

  friend bool operator==(const IdentitySettings&, const IdentitySettings&) = default;
};

/// As printed: every image may add landmarks after two sightings, every bearing counts in full, and the looks of all
/// images are kept.
IdentitySettings paper_identity_preset();

}  // namespace azimuth
