#pragma once
// How far the errors of many drives lie within what is said of them.

#include <span>
#include <vector>

#include "drivers/storage/run.hpp"
#include "settings/configuration.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/report.hpp"

namespace azimuth {

/// Of one estimate, as it was live.
struct ImageScore {
  TwoSigmaShare share;
  bool tracking = false;  ///< said its health
};

/// Of one drive.
struct WorldScore {
  Report report;
  std::vector<ImageScore> images;  ///< those of a covariance: not the first one, nor before the robot moved
};
/// The run without its names through the configured estimator, as `azimuth replay --no-names` has it.
WorldScore score_without_names(const Run& run, const Configuration& configuration);

enum class SigmaMeasure { ellipse, direction };

/// Of all images of these drives, or of those that said `tracking`; sorted.
std::vector<double> two_sigma_shares(std::span<const WorldScore> worlds, SigmaMeasure measure, bool tracking_only);

/// How many of the sorted values are at most `limit`, as a share; kNotMeasured of none.
double share_within(std::span<const double> sorted, double limit = 1.0);
/// By nearest rank; kNotMeasured of none.
double quantile(std::span<const double> sorted, double share);

}  // namespace azimuth
