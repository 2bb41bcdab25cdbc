#pragma once
#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// Rounds as in recordings: lengths to the micrometre, times and angles to a millionth.
double recorded(double value);

/// The part of a run that is known in advance: its name, its rig.toml and the landmarks' positions.
Run run_of(const Scenario& scenario);

}  // namespace azimuth
