#include "slam/planar/ekf_settings.hpp"

#include "slam/geometry/angle.hpp"

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

double printed_kl_threshold(double sigma_bearing_rad) { return sigma_bearing_rad > degrees_to_rad(1.0) ? 12.0 : 3.0; }

EkfSettings paper_preset() {
  EkfSettings settings;
  settings.initialisation = Initialisation::delayed;
  settings.delayed.kl_threshold = 0.0;
  settings.delayed.best_pair = false;
  settings.delayed.gate_remaining = false;
  settings.gates.chi2 = 0.0;
  settings.gates.joint_probability = 0.0;
  settings.recover_after_rejections = 0;
  settings.relocation.bearings = 0;
  settings.merging.after_images = 0;
  settings.centre.sigma_px = 0.0;
  settings.centre.second_start_px = 0.0;
  settings.unnamed.start_hypotheses = 1;
  settings.thinning_s = 0.0;
  settings.delayed.expire_after_clones = 0;
  settings.delayed.min_clone_baseline_m = 0.0;
  settings.update.invariant = false;
  settings.update.charge_curvature = false;
  settings.update.consider_scales = false;
  settings.update.max_iterations = 1;
  return settings;
}

}  // namespace azimuth
