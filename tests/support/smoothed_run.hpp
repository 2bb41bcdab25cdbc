#pragma once
// A run with known names through the smoother, as it would go live, and what it says of the past at the end.

#include <functional>
#include <vector>

#include "drivers/storage/run.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/smoother/known_names.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// How the rig's noise and floors become the graph's.
KnownNamesSettings settings_for(const Rig& rig, const SmootherSettings& settings);

struct SmoothedRun {
  std::vector<EstimateRecord> online, smoothed;  ///< one for each bearing set
  std::vector<double> step_us;                   ///< CPU time of each set that was used, its pose's covariance included
  std::int32_t poses = 0, landmarks = 0, bearings = 0;
  std::size_t damped = 0, not_converged = 0;
  double energy = 0.0;
};
/// `every_set`, when given, is called after each.
SmoothedRun smoothed_run(const Run& run, const Rig& rig, const KnownNamesSettings& settings,
                         const std::function<void(const KnownNames&)>& every_set = {});

/// RMSE of the position after one rigid fit, ANEES relative to the first pose.
struct RunError {
  double rmse_m = 0.0, anees = 0.0;
};
RunError run_error(const Run& run, const std::vector<EstimateRecord>& estimates);

}  // namespace azimuth
