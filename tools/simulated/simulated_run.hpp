#pragma once
#include <string>

#include "drivers/io/run.hpp"
#include "sim/world/scenario.hpp"
#include "sim/world/simulate.hpp"

namespace azimuth {

/// The rig.toml of the simulated robot: its noise and calibration are exactly those of the scenario.
std::string rig_toml(const Scenario& scenario);

/// Drives through the scenario and hands over what a recording robot would have written.
Run simulated_run(const Scenario& scenario);

}  // namespace azimuth
