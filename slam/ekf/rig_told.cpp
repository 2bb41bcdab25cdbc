#include "slam/ekf/rig_told.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "slam/geometry/wrong_rig.hpp"

namespace azimuth {
namespace {

constexpr double kExact = 0.0;
constexpr double kLogOddsAgainst = 3.0;  // prior log odds that a value of the rig is right: one in twenty is wrong
// A doubted error below this many standard deviations, once other constants are doubted too, was caused by the other
// constants and is no contradiction.
constexpr double kTold_sigmas = 2.0;
using Matrix = Eigen::Matrix<double, considered::kCount, considered::kCount>;

/// Standard deviations of a wrong rig's errors. Zero for the scale of distance, which bearings do not observe.
Considered if_wrong() {
  Considered sigma = Considered::Constant(kExact);
  sigma(considered::scale_turn) = wrong_rig::kScaleTurn;
  sigma(considered::lag) = wrong_rig::kLag_s;
  sigma(considered::drift) = wrong_rig::kDrift_rad_per_m;
  sigma(considered::yaw) = wrong_rig::kYaw_rad;
  sigma.segment<2>(considered::camera).setConstant(wrong_rig::kCamera_m);
  return sigma;
}

struct Posterior {
  Considered mean;
  Matrix covariance;
};

/// `known`: prior information on each constant; ignored for exact ones.
std::optional<Posterior> posterior(const JointState& state, const Considered& known) {
  Matrix information = state.told_of_considered().information;
  Considered pull = state.told_of_considered().pull;
  for (int i = 0; i < considered::kCount; ++i) {
    if (state.considered()(i) <= kExact) {  // exact: takes no part
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
}

/// The evidence on one constant, whatever the others are.
struct Doubt {
  double log_odds = 0.0;  ///< Log odds that the rig's value is wrong, without the prior odds
  double sigmas = 0.0;    ///< Error by the innovations alone, in standard deviations of this error
  double if_wrong = 0.0;  ///< Mean error if the rig is wrong

  bool is_enough() const { return log_odds > kLogOddsToDoubt && sigmas > kCertainOfRig_sigmas; }
};

Doubt doubt(double mean, double variance, double said, double wide) {
  const double told = 1.0 / variance - 1.0 / (said * said), pull = mean / variance;
  if (!(told > 0.0)) return {};
  return {log_evidence(mean, variance, said, wide, said), std::abs(pull) / std::sqrt(told),
          pull / (told + 1.0 / (wide * wide))};
}

}  // namespace

bool RigTold::doubts_any() const { return std::ranges::any_of(doubted, std::identity{}); }

Considered RigTold::believable() const {
  Considered errors = Considered::Zero();
  for (int i = 0; i < considered::kCount; ++i)
    if (is_doubted(i)) errors(i) = mean(i);
  return errors;
}

RigTold told_of_rig(const JointState& state) {
  static const Considered kIfWrong = if_wrong();
  const Considered said = state.considered().cwiseSqrt();
  RigTold told{.mean = Considered::Zero(), .sigma = said, .doubted = {}, .left = state.considered()};
  Considered prior = said;
  while (const auto found = posterior(state, prior.cwiseAbs2().cwiseInverse())) {
    told.mean = found->mean;
    told.sigma = found->covariance.diagonal().cwiseSqrt();
    int worst = -1;
    double most = kLogOddsToStay;
    for (int i = 0; i < considered::kCount; ++i) {
      if (told.is_doubted(i)) told.left(i) = found->covariance(i, i);
      if (said(i) <= kExact || kIfWrong(i) <= said(i) || told.is_doubted(i)) continue;
      const Doubt about = doubt(told.mean(i), found->covariance(i, i), said(i), kIfWrong(i));
      const double wrong = 1.0 / (1.0 + std::exp(kLogOddsAgainst - about.log_odds));
      told.left(i) = state.considered()(i) + wrong * about.if_wrong * about.if_wrong;
      const bool was_doubted = state.believed()(i) != 0.0;
      if (about.log_odds <= most || !(was_doubted || about.is_enough())) continue;
      most = about.log_odds;
      worst = i;
    }
    if (worst < 0) break;
    told.doubted[static_cast<std::size_t>(worst)] = true;
    prior(worst) = kIfWrong(worst);
  }
  for (int i = 0; i < considered::kCount; ++i) {
    if (!told.is_doubted(i) || std::abs(told.mean(i)) > kTold_sigmas * told.sigma(i)) continue;
    told.doubted[static_cast<std::size_t>(i)] = false;
    told.left(i) += told.mean(i) * told.mean(i);
  }
  return told;
}

/// Removes the prior of the lag from the posterior.
std::optional<LagFound> lag_found(const JointState& state, const RigTold& rig) {
  if (state.considered()(considered::lag) <= kExact) return std::nullopt;
  const double known = rig.is_doubted(considered::lag) ? 1.0 / (wrong_rig::kLag_s * wrong_rig::kLag_s)
                                                       : 1.0 / state.considered()(considered::lag);
  const double variance_s2 = rig.sigma(considered::lag) * rig.sigma(considered::lag);
  const double told = 1.0 / variance_s2 - known;
  if (!(told > 0.0) || !std::isfinite(told)) return std::nullopt;
  return LagFound{rig.mean(considered::lag) / variance_s2 / told, 1.0 / std::sqrt(told)};
}

}  // namespace azimuth
