#include "slam/planar/identity_settings.hpp"

namespace azimuth {

IdentitySettings paper_identity_preset() {
  IdentitySettings settings;
  settings.validation = FeatureValidation::geometry;
  settings.rivals_elsewhere = false;
  settings.max_ratio = 0.6;
  settings.pattern_correlation = 0.8;
  settings.pattern_members = 2;
  settings.min_sigma_rad = 0.0087;
  settings.independent_bearings = 0;
  settings.enough_in_sight = 0;
  settings.min_observations = 2;
  // Keep the descriptors of all images, as far as there is room.
  settings.views_per_identity = 1000;
  settings.view_spacing_m = 0.0;
  settings.stable_sightings = 1;
  return settings;
}

}  // namespace azimuth
