#pragma once
#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// Lengths are recorded to the micrometre, times and angles to a millionth.
double recorded(double value);

/// What a run in that world knows before it begins: its name, its rig.toml and where the landmarks are.
Run run_of(const Scenario& scenario);

}  // namespace azimuth
