#pragma once
#include <memory>

#include "slam/estimator/ekf_settings.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/fastslam/fastslam_settings.hpp"

namespace azimuth {

/// The bearing-only EKF (SPEC part I) for a rig.
std::unique_ptr<Estimator> make_ekf_estimator(const Rig& rig, const EkfSettings& settings);

/// FastSLAM (SPEC part II) for a rig whose bearings carry elevations.
std::unique_ptr<Estimator> make_fastslam_estimator(const Rig& rig, const FastSlamSettings& settings);

}  // namespace azimuth
