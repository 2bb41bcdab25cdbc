#pragma once
#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"
#include "sim/world/simulate.hpp"

namespace azimuth {

/// Drives through the scenario and hands over what a recording robot would have written.
Run simulated_run(const Scenario& scenario);

}  // namespace azimuth
