#pragma once
// When a drive contradicts a rig, whichever estimator finds it (SPEC VI.33).

#include <cmath>

namespace azimuth {

/// How far off a rig is that is wrong, as standard deviations: a camera put on by eye, an odometer of another robot's,
/// a buffer on the way.
namespace wrong_rig {
inline constexpr double kScaleTurn = 0.3, kDrift_rad_per_m = 0.05, kYaw_rad = 0.1, kLag_s = 0.3, kCamera_m = 0.3;
}

/// One value of a rig in twenty is wrong, and that one is takes odds of twenty to one to be acted upon.
inline constexpr double kLogOddsToDoubt = 6.0;
/// Errors that several bearings share make a filter seem to know more than it does: drives without a lag had one that
/// was up to 4.7 standard deviations off.
inline constexpr double kCertainOfRig_sigmas = 6.0;

/// Logarithm of how much likelier all measurements are if a calibration is known to `wide` before than to `narrow`,
/// when it has come out as `mean` with `variance` by a prior of `prior`: all standard deviations but that. Reentrant.
inline double log_evidence(double mean, double variance, double prior, double wide, double narrow) {
  const double told = 1.0 / variance - 1.0 / (prior * prior), pull = mean / variance;
  const auto log_likelihood = [&](double sigma) {
    const double known = 1.0 / (sigma * sigma);
    return 0.5 * (std::log(known / (told + known)) + pull * pull / (told + known));
  };
  return log_likelihood(wide) - log_likelihood(narrow);
}

}  // namespace azimuth
