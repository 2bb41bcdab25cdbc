#pragma once
// Constants and odds for deciding that a drive contradicts the rig, common to all estimators (mathematics VI.33).

#include <cmath>

namespace azimuth {

/// Standard deviations of the errors of a wrong rig: a camera mounted by eye, the odometer of another robot, a buffer
/// that delays samples.
namespace wrong_rig {
inline constexpr double kScaleTurn = 0.3, kDrift_rad_per_m = 0.05, kYaw_rad = 0.1, kLag_s = 0.3, kCamera_m = 0.3;
}

/// ln of the odds needed to treat a value of the rig as wrong: one value in twenty is wrong, and acting on it takes
/// odds of twenty to one.
inline constexpr double kLogOddsToDoubt = 6.0;
/// ln of the odds below which a doubted value is believed again.
inline constexpr double kLogOddsToStay = 0.0;
/// Bound on a plausible error, in standard deviations of a wrong rig.
inline constexpr double kPossible_sigmas = 3.0;
/// Error, in a filter's own standard deviations, below which the rig is not contradicted. Errors that several bearings
/// share make a filter's covariance too small.
inline constexpr double kCertainOfRig_sigmas = 6.0;

/// ln of the likelihood ratio of all measurements for a prior standard deviation of `wide` against `narrow`, for a
/// calibration value that was estimated as `mean` with `variance` under a prior standard deviation of `prior`.
/// Reentrant.
inline double log_evidence(double mean, double variance, double prior, double wide, double narrow) {
  const double told = 1.0 / variance - 1.0 / (prior * prior), pull = mean / variance;
  const auto log_likelihood = [&](double sigma) {
    const double known = 1.0 / (sigma * sigma);
    return 0.5 * (std::log(known / (told + known)) + pull * pull / (told + known));
  };
  return log_likelihood(wide) - log_likelihood(narrow);
}

}  // namespace azimuth
