#pragma once
#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"
#include "sim/world/simulate.hpp"

namespace azimuth {

/// Drives through the scenario and hands over what a recording robot would have written.
Run simulated_run(const Scenario& scenario);

/// What was recorded within `most_s` of the first odometry reading.
Run first_seconds(Run run, double most_s);

}  // namespace azimuth
