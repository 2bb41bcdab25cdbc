#include <numbers>

#include "settings/configuration_sections.hpp"

namespace azimuth {
namespace {

std::vector<Key> decision_keys(IdentitySettings& identity) {
  return {
      everyday(
          choice<FeatureValidation>("validation", identity.validation,
                                    {{"geometry", FeatureValidation::geometry},
                                     {"patterns", FeatureValidation::patterns},
                                     {"combined", FeatureValidation::combined}},
                                    "What must speak for a match with a landmark not in the map yet. geometry: every "
                                    "earlier bearing of it; patterns: the features around it; combined: geometry, and "
                                    "patterns as well where that allows nearly anything.")),
      {"rivals_elsewhere", &identity.rivals_elsewhere,
       "A feature is compared with landmarks that can be where it is seen, and its rivals are those that cannot; "
       "false: with all, each the other's rival."},
      {"max_ratio", &identity.max_ratio,
       "Distance to the most alike view over that to the most alike of the rivals, at most.", above_to(0, 1)},
      {"gate_chi2", &identity.gate_chi2,
       "Gate on the squared innovation over its variance of a match with a mapped landmark.", above_to(0, 1000)},
      {"pattern_correlation", &identity.pattern_correlation,
       "Patterns: two neighbours are the same above this correlation.", from_to(-1, 1)},
      {"pattern_members", &identity.pattern_members, "Patterns: neighbours that must be found again.", from_to(1, 5)},
      {"combined_sweep_rad", &identity.combined_sweep_rad,
       "Combined: an interval of possible directions wider than this proves little.", from_to(0, std::numbers::pi)},
  };
}

std::vector<Key> filter_keys(IdentitySettings& identity) {
  return {
      {"min_sigma_rad", &identity.min_sigma_rad, "No feature's bearing is believed to be better than this.",
       above_to(0, std::numbers::pi)},
      {"independent_bearings", &identity.independent_bearings,
       "In an image with more recognised features than this each counts for less, since they share errors; 0: never.",
       from_to(0, 4096)},
      {"enough_in_sight", &identity.enough_in_sight,
       "An image that shows so many mapped landmarks adds no new ones; 0: every image may.", from_to(0, 4096)},
      {"max_iterations", &identity.max_iterations,
       "Iterations of one update at most, with many features; 1: the plain EKF.", from_to(1, 100)},
      {"min_observations", &identity.min_observations, "Sightings before a feature becomes a landmark, at least.",
       from_to(2, 1000)},
  };
}

std::vector<Key> store_keys(IdentitySettings& identity) {
  return {
      {"max_views", &identity.max_views, "Views kept, of all landmarks together.", from_to(16, 1000000)},
      {"views_per_identity", &identity.views_per_identity, "Views kept of one landmark, from different places.",
       from_to(1, 1000)},
      {"view_spacing_m", &identity.view_spacing_m,
       "Views of one landmark from places nearer together than this are one: only the newest is kept.",
       from_to(0, 1000)},
      {"stable_sightings", &identity.stable_sightings, "A landmark seen less often is unstable.", from_to(1, 1000)},
      {"forget_after_m", &identity.forget_after_m,
       "Driven since an unstable landmark was last seen, until its looks are forgotten.", above_to(0, 100000)},
  };
}

}  // namespace

Section identity_section(IdentitySettings& identity, Preset& preset) {
  return {
      "identity", "Telling features apart by their looks, where bearings have no names (front end \"sift\").",
      joined({{preset_key(
                  preset,
                  "Values of the keys not given here. paper: as printed; overconfident where many features are seen.")},
              decision_keys(identity),
              filter_keys(identity),
              store_keys(identity)})};
}

}  // namespace azimuth
