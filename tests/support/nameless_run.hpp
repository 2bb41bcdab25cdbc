#pragma once
// Processes a run without names with the hypotheses, as in live operation, and also returns the final estimate of the
// past poses. Names in the run serve for evaluation only.

#include <optional>
#include <string>
#include <vector>

#include "slam/hypotheses/nameless.hpp"
#include "tests/support/smoothed_run.hpp"

namespace azimuth {

/// Converts the rig's field of view, noise and floors to settings of the beam.
NamelessSettings nameless_settings_for(const Rig& rig);

struct NamelessRun {
  /// An image that was used.
  struct Used {
    std::size_t record = 0;  ///< index in `online`
    Trust trust;
    std::string trace;  ///< evidence that the trust is based on
  };
  std::vector<EstimateRecord> online, smoothed, odometry;  ///< one per bearing set
  std::vector<Trust> trust;                                ///< one per bearing set
  std::vector<Used> used;
  std::vector<double> step_us;  ///< CPU time of all threads for each set that was used
  double energy = 0.0;
};
struct NamelessMapScore {
  int landmarks = 0, mapped = 0, duplicates = 0, assigned = 0, wrong = 0, bearings = 0;
};

/// Returns the live estimates, the smoothed estimates, and dead reckoning with its own covariance.
NamelessRun nameless_run(const Run& run, const Rig& rig, const NamelessSettings& settings, Workers& workers,
                         NamelessMapScore& score);

/// Error of each record relative to the first one, (x, y, heading) in the map; no value where the run has no truth.
std::vector<std::optional<Eigen::Vector3d>> errors_of_each(const Run& run, const std::vector<EstimateRecord>& records);

/// Share of the live poses that are trusted, and their ANEES.
struct TrustScore {
  double share = 0.0, anees = 0.0;
};
TrustScore trust_score(const Run& run, const NamelessRun& result);

}  // namespace azimuth
