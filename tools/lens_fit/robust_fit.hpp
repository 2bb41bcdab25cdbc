#pragma once
// Common part of the lens fits: damped Gauss-Newton on sparse equations, with the Cauchy kernel on image observations.

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace azimuth {

/// The equations J dx = -e. Each row is whitened; rows of observations also include the robust weight.
struct FitEquations {
  Eigen::SparseMatrix<double> J;
  Eigen::VectorXd e;
  double cost = 0.0;                           ///< including the robust kernel
  std::vector<double> mahalanobis2, error_px;  ///< for each observation; infinite and NaN if the lens has no image
};

/// Residual, in standard deviations, at which the Cauchy kernel gives an observation half weight.
inline constexpr double kHalfWeight = 3.0;

/// `fits`: whether an observation has at least half weight. `unit_variance`: ratio of the residual variance to the
/// stated variance.
struct SightingWeights {
  std::vector<bool> fits;
  double unit_variance = 1.0;
};
/// `unknowns`: number of unknowns that only the observations determine. If no degrees of freedom are left, the unit
/// variance is 1.
SightingWeights weigh(const std::vector<double>& mahalanobis2, double unknowns);

/// The damped Gauss-Newton step. Nothing if the damped information matrix is singular.
std::optional<Eigen::VectorXd> damped_step(const FitEquations& equations, double damping);

/// Covariance of the first `count` unknowns. Nothing if the information matrix is singular.
std::optional<Eigen::MatrixXd> leading_covariance(const FitEquations& equations, Eigen::Index count);

template <class State>
struct Settled {
  State at;
  FitEquations equations;
};

/// Minimises the cost from the initial state `at`. `equations_at(state)` returns FitEquations; `moved(state, step)`
/// returns the state after a step. Nothing if the measurements do not determine the unknowns. Deterministic.
template <class State, class EquationsAt, class Moved>
std::optional<Settled<State>> settled(State at, const EquationsAt& equations_at, const Moved& moved) {
  constexpr int kMostSteps = 60;
  constexpr double kSettled = 1e-9;  // relative decrease of the cost
  // Weakly determined directions hardly move in a damped step. Only a step with no more damping than this may therefore
  // end the iteration.
  constexpr double kUndamped = 1e-13;
  FitEquations equations = equations_at(at);
  double damping = 1e-5;
  for (int i = 0; i < kMostSteps && damping < 1e8; ++i) {
    const std::optional<Eigen::VectorXd> step = damped_step(equations, damping);
    if (!step) return std::nullopt;
    State next = moved(at, *step);
    FitEquations there = equations_at(next);
    if (!(there.cost < equations.cost)) {
      if (damping <= kUndamped && there.cost - equations.cost < kSettled * equations.cost) break;
      damping = std::max(10.0 * damping, 1e-9);
      continue;
    }
    const bool done = damping <= kUndamped && equations.cost - there.cost < kSettled * equations.cost;
    at = std::move(next);
    equations = std::move(there);
    damping = damping < 1e-10 ? 0.0 : 0.01 * damping;
    if (done) break;
  }
  return Settled<State>{std::move(at), std::move(equations)};
}

/// Cauchy weight of an observation with this squared Mahalanobis distance.
inline double cauchy_weight(double mahalanobis2) { return 1.0 / (1.0 + mahalanobis2 / (kHalfWeight * kHalfWeight)); }
inline double cauchy_cost(double mahalanobis2) {
  return 0.5 * kHalfWeight * kHalfWeight * std::log1p(mahalanobis2 / (kHalfWeight * kHalfWeight));
}
/// Cost of an observation whose object has no image under the present lens.
inline double lost_cost() {
  constexpr double kGone2 = 1e4;
  return 0.5 * kHalfWeight * kHalfWeight * std::log1p(kGone2);
}

/// Root mean square of the residuals that fit; 0 if none fits.
double rms_px(const std::vector<double>& error_px, const std::vector<bool>& fits);
/// Share of the elements that are true; 0 if there are none.
double share(const std::vector<bool>& fits);

}  // namespace azimuth
