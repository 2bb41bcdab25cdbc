#pragma once
#include <string>
#include <vector>

#include "tools/doctor/finding.hpp"
#include "tools/doctor/machine.hpp"

namespace azimuth {

/// What the daemon is to use on the machine.
struct Plan {
  std::vector<std::string> devices;  ///< of the robot; empty: every USB adapter that is plugged in
  std::string recording_folder;      ///< empty: nothing is recorded
  double min_free_mb = 500.0;
  std::string configuration;  ///< file; empty: not checked
  std::string version;        ///< of this program
};

/// All checks, in the order in which a robot is set up.
Findings examine(const Machine& machine, const Plan& plan);

}  // namespace azimuth
