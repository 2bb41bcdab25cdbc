#include "slam/fastslam/fastslam_settings.hpp"

#include "slam/geometry/angle.hpp"

namespace azimuth {

FastSlamSettings paper_fastslam_preset() {
  FastSlamSettings settings;
  settings.association.likelihood = LampLikelihood::paper;
  settings.association.cost = LampCost::probability;
  settings.relinearise = true;
  settings.weight.method = ParticleWeight::product;
  settings.refute_landmarks = false;
  settings.weight.resample_below_share = 1.0;
  settings.candidates.min_parallax_rad = 1.22;
  settings.new_lamp.covariance = NewLampCovariance::fixed;
  settings.key_distance_m = 0.0;
  return settings;
}

FastSlamSettings paper_7deg_fastslam_preset() {
  FastSlamSettings settings = paper_fastslam_preset();
  settings.candidates.min_parallax_rad = degrees_to_rad(7.0);
  return settings;
}

}  // namespace azimuth
