#pragma once
// Constants and odds for deciding that a drive contradicts the rig, common to all estimators (mathematics VI.33).

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

namespace azimuth {

/// Standard deviations of the errors of a wrong rig: a camera mounted by eye, the odometer of another robot, a buffer
/// that delays samples.
namespace wrong_rig {
inline constexpr double kScaleTurn = 0.3, kDrift_rad_per_m = 0.05, kYaw_rad = 0.1, kLag_s = 0.3, kCamera_m = 0.3;
}

/// ln of the odds needed to treat a value of the rig as wrong: one value in twenty is wrong, and acting on it takes
/// odds of twenty to one.
inline constexpr double kLogOddsToDoubt = 6.0;
/// ln of the odds from which on a value is more probably wrong than right, as one value in twenty is wrong.
inline constexpr double kLogOddsProbable = 3.0;
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

/// The errors of `N` values of a rig as measurements tell them, without a prior: information matrix A and pull b; A^-1
/// b is the most likely error.
template <int N>
struct RigEvidence {
  Eigen::Matrix<double, N, N> information = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> pull = Eigen::Matrix<double, N, 1>::Zero();
};

/// The judgement of a rig by its evidence.
template <int N>
struct RigErrors {
  using Vector = Eigen::Matrix<double, N, 1>;
  /// Errors of the rig and their standard deviations, from the evidence and the prior. The prior is the rig's sigma
  /// or, where the evidence contradicts the rig, the typical error of a wrong rig.
  Vector mean = Vector::Zero(), sigma = Vector::Zero();
  Vector log_odds = Vector::Zero();  ///< of each value being wrong, without the prior odds
  std::array<bool, N> doubted{};
  /// Remaining variances of the errors, once the doubted ones are corrected for. For an error that is not doubted it
  /// includes the size that the evidence indicates, weighted by the probability that the rig is wrong.
  Vector left = Vector::Zero();

  bool is_doubted(int which) const { return doubted[static_cast<std::size_t>(which)]; }
  bool doubts_any() const { return std::ranges::any_of(doubted, std::identity{}); }
  /// Whether the value is doubted by the odds that are demanded to say so.
  bool is_contradicted(int which) const { return is_doubted(which) && log_odds(which) > kLogOddsToDoubt; }
  /// The errors to correct for: those that are doubted.
  Vector believable() const {
    Vector errors = Vector::Zero();
    for (int i = 0; i < N; ++i)
      if (is_doubted(i)) errors(i) = mean(i);
    return errors;
  }
};

/// Tests the rig for contradictions: one value after the other, the most contradicted first, since one wrong value
/// makes others seem wrong (mathematics VI.33, VI.35). `variance` are the rig's own variances, 0: exact. `if_wrong` are
/// the standard deviations of a wrong rig; values with no larger one are never doubted. A value that is already
/// corrected for (`before`) stays in doubt until its error is less likely than the rig. An error below `certain_sigmas`
/// standard deviations of the evidence alone is no contradiction.
template <int N>
RigErrors<N> judged(const RigEvidence<N>& evidence, const Eigen::Matrix<double, N, 1>& variance,
                    const Eigen::Matrix<double, N, 1>& if_wrong, const std::array<bool, N>& before,
                    double certain_sigmas = 0.0) {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  constexpr double kExact = 0.0;
  // A doubted error below this many standard deviations, once other values are doubted too, was caused by the other
  // values and is no contradiction.
  constexpr double kTold_sigmas = 2.0;
  // Evidence with a larger standard deviation than this share of a wrong rig's is no contradiction: so weak evidence is
  // what small errors of the linearisation amount to, and a drive straight ahead would tell where the camera is.
  constexpr double kToldWithin = 1.0 / 3.0;
  const Vector said = variance.cwiseSqrt();
  struct Posterior {
    Vector mean;
    Matrix covariance;
  };
  const auto posterior = [&](const Vector& known) -> std::optional<Posterior> {
    Matrix information = evidence.information;
    Vector pull = evidence.pull;
    for (int i = 0; i < N; ++i) {
      if (variance(i) <= kExact) {  // takes no part
        information.row(i).setZero();
        information.col(i).setZero();
        information(i, i) = 1.0;
        pull(i) = 0.0;
      } else {
        information(i, i) += known(i);
      }
    }
    const Eigen::LLT<Matrix> factor(information);
    if (factor.info() != Eigen::Success) return std::nullopt;
    return Posterior{factor.solve(pull), factor.solve(Matrix::Identity())};
  };

  RigErrors<N> errors{.sigma = said, .left = variance};
  Vector prior = said;
  while (const auto found = posterior(prior.cwiseAbs2().cwiseInverse())) {
    errors.mean = found->mean;
    errors.sigma = found->covariance.diagonal().cwiseSqrt();
    int worst = -1;
    double most = kLogOddsToStay;
    for (int i = 0; i < N; ++i) {
      if (errors.is_doubted(i)) errors.left(i) = found->covariance(i, i);
      if (said(i) <= kExact || if_wrong(i) <= said(i)) continue;
      const double alone =
          1.0 / found->covariance(i, i) - 1.0 / (prior(i) * prior(i));  // information without the prior
      const double pull = found->mean(i) / found->covariance(i, i);
      const bool tells = alone > 0.0;
      const double log_odds =
          tells ? log_evidence(found->mean(i), found->covariance(i, i), prior(i), if_wrong(i), said(i)) : 0.0;
      errors.log_odds(i) = log_odds;
      if (errors.is_doubted(i)) continue;
      const double wrong = 1.0 / (1.0 + std::exp(kLogOddsProbable - log_odds));
      const double error_if_wrong = tells ? pull / (alone + 1.0 / (if_wrong(i) * if_wrong(i))) : 0.0;
      errors.left(i) = variance(i) + wrong * error_if_wrong * error_if_wrong;
      const bool is_enough = log_odds > kLogOddsToDoubt && std::abs(pull) > certain_sigmas * std::sqrt(alone) &&
                             alone * std::pow(kToldWithin * if_wrong(i), 2) > 1.0;
      if (log_odds <= most || !(before[static_cast<std::size_t>(i)] || is_enough)) continue;
      most = log_odds;
      worst = i;
    }
    if (worst < 0) break;
    errors.doubted[static_cast<std::size_t>(worst)] = true;
    prior(worst) = if_wrong(worst);
  }
  for (int i = 0; i < N; ++i) {
    if (!errors.is_doubted(i) || std::abs(errors.mean(i)) > kTold_sigmas * errors.sigma(i)) continue;
    errors.doubted[static_cast<std::size_t>(i)] = false;
    errors.left(i) += errors.mean(i) * errors.mean(i);
  }
  return errors;
}

}  // namespace azimuth
