#pragma once
#include <string>
#include <string_view>

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// The rig.toml of the simulated robot, with exactly the noise and calibration of the scenario.
std::string rig_toml(const Scenario& scenario);
/// The rig.toml of the simulated robot with another camera; `camera_text` contains `front_end` and the table [camera].
std::string rig_toml(const Scenario& scenario, std::string_view camera_text);

/// Rounds as in recordings: lengths to the micrometre, times and angles to a millionth.
double recorded(double value);

/// The part of a run that is known in advance: its name, its rig.toml and the landmarks' positions.
Run run_of(const Scenario& scenario);

}  // namespace azimuth
