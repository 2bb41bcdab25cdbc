#include "slam/planar/ekf_settings.hpp"

#include "slam/geometry/angle.hpp"

namespace azimuth {

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
