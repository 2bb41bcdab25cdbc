#include "slam/fastslam/fastslam_settings.hpp"

#include "slam/geometry/angle.hpp"

namespace azimuth {

FastSlamSettings paper_fastslam_preset() {
  FastSlamSettings settings;
  settings.likelihood = LampLikelihood::paper;
  settings.cost = LampCost::probability;
  settings.relinearise = true;
  settings.weight = ParticleWeight::product;
  settings.refute_landmarks = false;
  settings.resample_below_share = 1.0;
  settings.min_parallax_rad = 1.22;
  settings.new_covariance = NewLampCovariance::fixed;
  settings.key_distance_m = 0.0;
  return settings;
}

FastSlamSettings paper_7deg_fastslam_preset() {
  FastSlamSettings settings = paper_fastslam_preset();
  settings.min_parallax_rad = degrees_to_rad(7.0);
  return settings;
}

}  // namespace azimuth
