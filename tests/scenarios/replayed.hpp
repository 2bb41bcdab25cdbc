#pragma once
// Runs through the stage that the daemon runs, judged as `azimuth replay` judges them.

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

/// The rig of the run; fails the test when its text is not valid.
Rig rig_of(const Run& run);

Report replayed(const Run& run, const Rig& rig, const EkfSettings& settings = {});
inline Report replayed(const Run& run, const EkfSettings& settings = {}) {
  return replayed(run, rig_of(run), settings);
}

/// Likewise by the smoother.
Report replayed_in_hindsight(const Run& run, const Rig& rig, const HindsightSettings& settings = {});
inline Report replayed_in_hindsight(const Run& run, const HindsightSettings& settings = {}) {
  return replayed_in_hindsight(run, rig_of(run), settings);
}

/// A pose farther off than this, or none at all, counts as divergence.
inline constexpr double kDiverged_m = 1.5;

/// What many runs of a kind have in common.
struct Runs {
  std::vector<Report> reports;

  double mean_of(const std::function<double(const Report&)>& value) const;
  double mean_m() const;      ///< mean of the runs' mean position errors
  double worst_m() const;     ///< the largest position error of any run
  double anees() const;       ///< mean of the runs'
  double smoothed_m() const;  ///< mean of the runs' mean position errors as they are known at the end
  int diverged() const;
  /// One line: the numbers above, for the log of the test.
  void print(const std::string& title) const;
};

/// One run for each seed from 1 on; `make` builds it.
Runs replay_seeds(int seeds, const std::function<Report(std::uint64_t seed)>& make);

}  // namespace azimuth
