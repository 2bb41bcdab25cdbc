#pragma once
// How features that have descriptors but no names are told apart (mathematics I.12 to I.14): units and tuned defaults.
// `paper_identity_preset` holds the values printed in the paper.

#include <cstdint>

namespace azimuth {

/// What must support a match with a landmark that is not in the map yet, besides its descriptor.
enum class FeatureValidation : std::uint8_t {
  geometry,  ///< Every earlier bearing allows the new direction (mathematics I.13)
  patterns,  ///< The neighbouring features match (mathematics I.14)
  combined   ///< Geometry, and patterns too where geometry allows nearly any direction
};

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

}  // namespace azimuth
