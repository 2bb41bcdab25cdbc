#pragma once
#include "tools/doctor/finding.hpp"
#include "tools/doctor/machine.hpp"
#include "tools/doctor/plan.hpp"

namespace azimuth {

/// Runs all checks, in the order in which a robot is set up.
Findings examine(const Machine& machine, const Plan& plan);

}  // namespace azimuth
