#include "slam/planar/ekf_settings.hpp"

#include "slam/geometry/angle.hpp"

namespace azimuth {

double printed_kl_threshold(double sigma_bearing_rad) { return sigma_bearing_rad > degrees_to_rad(1.0) ? 12.0 : 3.0; }

EkfSettings paper_preset() {
  EkfSettings settings;
  settings.initialisation = Initialisation::delayed;
  settings.kl_threshold = 0.0;
  settings.best_pair = false;
  settings.gate_remaining = false;
  settings.gate_chi2 = 0.0;
  settings.joint_gate_probability = 0.0;
  settings.recover_after_rejections = 0;
  settings.relocation_bearings = 0;
  settings.relocalisation.lost_log_odds = 0.0;
  settings.merge_after_images = 0;
  settings.sigma_camera_centre_px = 0.0;
  settings.second_start_centre_px = 0.0;
  settings.start_hypotheses = 1;
  settings.thinning_s = 0.0;
  settings.expire_after_clones = 0;
  settings.min_clone_baseline_m = 0.0;
  settings.invariant_update = false;
  settings.charge_curvature = false;
  settings.consider_scales = false;
  settings.max_iterations = 1;
  return settings;
}

}  // namespace azimuth
