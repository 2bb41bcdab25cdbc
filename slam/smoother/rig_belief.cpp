#include "slam/smoother/rig_belief.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "slam/geometry/wrong_rig.hpp"

namespace azimuth {
namespace {

// Number of residuals that the rig's stated noise is worth, so that a short drive changes it little.
constexpr double kSaidCountsAs = 20.0;
// Exponent applied when the noise seems smaller than stated. A pose absorbs the errors that all bearings of its image
// share, so residuals understate the noise.
constexpr double kBelievedOfLess = 0.5;
constexpr std::array kStrides{1, 4, 16, 64};  // lengths of odometry in poses
constexpr double kWorthChanging = 1.05;       // ratio

double followed(const Smoother::Noise& noise, double believed, double said) {
  const double ratio = noise.ratio * believed / said, told = noise.told / (noise.told + kSaidCountsAs);
  return said * std::pow(ratio, (ratio < 1.0 ? kBelievedOfLess : 1.0) * told);
}

/// The largest odometry noise over short and long stretches of path. Errors that add up, such as a wrong scale, are
/// small from image to image.
double followed_odometry(const Smoother& smoother, double believed, double said) {
  double most = 0.0;
  for (const int stride : kStrides)
    most = std::max({most, followed(smoother.odometry_noise(stride), believed, said), said});
  return most;
}

bool is_worth_changing(double from, double to) { return to > kWorthChanging * from || from > kWorthChanging * to; }

}  // namespace

RigBelief rig_belief(const CalibrationPriors& said) { return {.sigma = sigmas(said)}; }

RigBelief judged(const Smoother& smoother, const RigBelief& belief, const RigBelief& said, const RigDoubts& doubts) {
  if (belief.is_beyond_repair()) return belief;
  RigBelief next = belief;
  const auto covariance = smoother.calibration_covariance();
  const Calibration if_wrong = sigmas(doubts.if_wrong);
  for (int i = 0; i < kCalibrations; ++i) {
    if (smoother.graph().calibration_row(i) < 0 || !(if_wrong[i] > said.sigma[i])) continue;
    const double log_odds =
        log_evidence(smoother.graph().calibration()[i], covariance(i, i), belief.sigma[i], if_wrong[i], said.sigma[i]);
    next.impossible[static_cast<std::size_t>(i)] =
        belief.is_doubted(i) && std::abs(smoother.graph().calibration()[i]) > kPossible_sigmas * if_wrong[i];
    const bool is_wrong =
        !next.is_impossible(i) && log_odds > (belief.is_doubted(i) ? kLogOddsToStay : kLogOddsToDoubt);
    next.doubted[static_cast<std::size_t>(i)] = is_wrong;
    next.sigma[i] = is_wrong ? if_wrong[i] : said.sigma[i];
  }
  if (next.is_beyond_repair()) {
    RigBelief given_up = said;
    given_up.impossible = next.impossible;
    return given_up;
  }
  if (!doubts.noise) return next;
  next.bearing_noise = followed(smoother.bearing_noise(), belief.bearing_noise, said.bearing_noise);
  next.odometry_noise = followed_odometry(smoother, belief.odometry_noise, said.odometry_noise);
  if (!is_worth_changing(belief.bearing_noise, next.bearing_noise) &&
      !is_worth_changing(belief.odometry_noise, next.odometry_noise)) {
    next.bearing_noise = belief.bearing_noise;
    next.odometry_noise = belief.odometry_noise;
  }
  return next;
}

bool change(Smoother& smoother, const RigBelief& belief, const RigBelief& next) {
  bool changes = false;
  for (int i = 0; i < kCalibrations; ++i) {
    if (smoother.graph().calibration_row(i) < 0 || next.sigma[i] == belief.sigma[i]) continue;
    smoother.set_calibration_sigma(i, next.sigma[i]);
    changes = true;
  }
  if (next.bearing_noise == belief.bearing_noise && next.odometry_noise == belief.odometry_noise) return changes;
  smoother.scale_noise(next.bearing_noise / belief.bearing_noise, next.odometry_noise / belief.odometry_noise);
  return true;
}

}  // namespace azimuth
