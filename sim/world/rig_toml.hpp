#pragma once
#include <string>
#include <string_view>

#include "sim/world/scenario.hpp"

namespace azimuth {

/// The rig.toml of the simulated robot: its noise and calibration are exactly those of the scenario.
std::string rig_toml(const Scenario& scenario);
/// The same with another camera; `camera_text` says `front_end` and the table [camera].
std::string rig_toml(const Scenario& scenario, std::string_view camera_text);

}  // namespace azimuth
