#pragma once
// Processes a run with known names with the smoother, as in live operation, and also returns the final estimate of the
// past poses.

#include <functional>
#include <vector>

#include "drivers/storage/run.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/smoother/known_names.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// Converts the noise and floors of the rig to settings of the graph.
KnownNamesSettings settings_for(const Rig& rig, const SmootherSettings& settings);

struct SmoothedRun {
  std::vector<EstimateRecord> online, smoothed;  ///< one per bearing set
  /// CPU time of each set that was used, including the covariance of its pose
  std::vector<double> step_us;
  std::int32_t poses = 0, landmarks = 0, bearings = 0;
  std::size_t damped = 0, not_converged = 0;
  double energy = 0.0;
};
/// Calls `every_set`, if given, after each set.
SmoothedRun smoothed_run(const Run& run, const Rig& rig, const KnownNamesSettings& settings,
                         const std::function<void(const KnownNames&)>& every_set = {});

/// RMSE of the position after a rigid alignment, and ANEES relative to the first pose.
struct RunError {
  double rmse_m = 0.0, anees = 0.0;
};
RunError run_error(const Run& run, const std::vector<EstimateRecord>& estimates);

}  // namespace azimuth
