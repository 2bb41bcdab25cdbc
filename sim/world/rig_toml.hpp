#pragma once
#include <string>

#include "sim/world/scenario.hpp"

namespace azimuth {

/// The rig.toml of the simulated robot: its noise and calibration are exactly those of the scenario.
std::string rig_toml(const Scenario& scenario);

}  // namespace azimuth
