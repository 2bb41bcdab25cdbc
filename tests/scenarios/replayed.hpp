#pragma once
// Replays runs through the daemon's estimator stage and evaluates them as `azimuth replay` does.

#include <functional>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "tools/evaluate/report.hpp"

namespace azimuth {

/// The rig of the run. The test fails if its text is invalid.
Rig rig_of(const Run& run);

Report replayed(const Run& run, const Rig& rig, const EkfSettings& settings = {});
inline Report replayed(const Run& run, const EkfSettings& settings = {}) {
  return replayed(run, rig_of(run), settings);
}

/// Replays the run with the smoother.
Report replayed_in_hindsight(const Run& run, const Rig& rig, const HindsightSettings& settings = {});
inline Report replayed_in_hindsight(const Run& run, const HindsightSettings& settings = {}) {
  return replayed_in_hindsight(run, rig_of(run), settings);
}

/// A run diverges if its largest position error exceeds this or if it has no pose.
inline constexpr double kDiverged_m = 1.5;

/// Summary of several runs of one kind.
struct Runs {
  std::vector<Report> reports;

  double mean_of(const std::function<double(const Report&)>& value) const;
  double mean_m() const;      ///< mean of the runs' mean position errors
  double worst_m() const;     ///< the largest position error of any run
  double anees() const;       ///< mean of the runs' ANEES
  double smoothed_m() const;  ///< mean of the runs' mean position errors in the final smoothed estimate
  int diverged() const;
  /// Prints one line with the numbers above to the test log.
  void print(const std::string& title) const;
};

/// Replays one run for each seed from 1 on, built by `make`.
Runs replay_seeds(int seeds, const std::function<Report(std::uint64_t seed)>& make);

}  // namespace azimuth
