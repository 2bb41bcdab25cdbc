#pragma once
// Scores how well the errors of many drives agree with the stated covariances.

#include <span>
#include <vector>

#include "drivers/storage/run.hpp"
#include "settings/configuration.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/report.hpp"

namespace azimuth {

/// Score of one live estimate.
struct ImageScore {
  TwoSigmaShare share;
  bool tracking = false;  ///< whether the estimate's health was `tracking`
};

/// Score of one drive.
struct WorldScore {
  Report report;
  std::vector<ImageScore> images;  ///< images with a covariance: neither the first nor those before the robot moved
};
/// Runs the configured estimator on the run without its names, as `azimuth replay --no-names` does.
WorldScore score_without_names(const Run& run, const Configuration& configuration);

enum class SigmaMeasure { ellipse, direction };

/// Shares of all images of these drives, or only of those whose health was `tracking`; sorted.
std::vector<double> two_sigma_shares(std::span<const WorldScore> worlds, SigmaMeasure measure, bool tracking_only);

/// Share of the sorted values that are at most `limit`; kNotMeasured if there are none.
double share_within(std::span<const double> sorted, double limit = 1.0);
/// Quantile by nearest rank; kNotMeasured if there are no values.
double quantile(std::span<const double> sorted, double share);

}  // namespace azimuth
