#include "settings/configured_estimator.hpp"

#include "slam/estimator/make_estimator.hpp"

namespace azimuth {

std::unique_ptr<Estimator> configured_estimator(const Rig& rig, const Configuration& configuration) {
  if (configuration.estimator == "fastslam") return make_fastslam_estimator(rig, configuration.fastslam);
  return make_ekf_estimator(rig, ekf_settings(configuration, rig.camera.sigma_bearing_rad));
}

}  // namespace azimuth
