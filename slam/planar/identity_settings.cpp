#include "slam/planar/identity_settings.hpp"

namespace azimuth {

IdentitySettings paper_identity_preset() {
  IdentitySettings settings;
  settings.validation = FeatureValidation::geometry;
  settings.max_ratio = 0.6;
  settings.pattern_correlation = 0.8;
  settings.pattern_members = 2;
  settings.min_sigma_rad = 0.0087;
  settings.independent_bearings = 0;
  settings.enough_in_sight = 0;
  settings.min_observations = 2;
  return settings;
}

}  // namespace azimuth
