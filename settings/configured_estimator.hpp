#pragma once
#include <memory>

#include "settings/configuration.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// The estimator that `configuration` names, for a rig.
std::unique_ptr<Estimator> configured_estimator(const Rig& rig, const Configuration& configuration);

}  // namespace azimuth
