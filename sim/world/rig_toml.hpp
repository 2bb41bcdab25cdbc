#pragma once
#include <string>
#include <string_view>

#include "sim/world/scenario.hpp"

namespace azimuth {

/// The rig.toml of the simulated robot, with exactly the noise and calibration of the scenario.
std::string rig_toml(const Scenario& scenario);
/// The rig.toml of the simulated robot with another camera; `camera_text` contains `front_end` and the table [camera].
std::string rig_toml(const Scenario& scenario, std::string_view camera_text);

}  // namespace azimuth
