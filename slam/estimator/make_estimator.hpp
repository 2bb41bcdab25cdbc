#pragma once
#include <memory>

#include "slam/estimator/ekf_settings.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// The bearing-only EKF (SPEC part I) for a rig.
std::unique_ptr<Estimator> make_ekf_estimator(const Rig& rig, const EkfSettings& settings);

}  // namespace azimuth
