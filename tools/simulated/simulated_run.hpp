#pragma once
#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"
#include "sim/world/simulate.hpp"

namespace azimuth {

/// Simulates the scenario and returns the run that a robot would have recorded.
Run simulated_run(const Scenario& scenario);

/// The part of the run within `most_s` seconds of the first odometry reading.
Run first_seconds(Run run, double most_s);

}  // namespace azimuth
