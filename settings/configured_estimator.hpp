#pragma once
#include <memory>
#include <string_view>

#include "settings/configuration.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// What runs: "ekf", "lamp_ekf" or "fastslam"; the one that `configuration` names, or the one for the rig.
std::string_view estimator_name(const Rig& rig, const Configuration& configuration);

/// The estimator of that name, for a rig.
std::unique_ptr<Estimator> configured_estimator(const Rig& rig, const Configuration& configuration);

}  // namespace azimuth
