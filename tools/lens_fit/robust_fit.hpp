#pragma once
// What the fits of a lens have in common: Gauss and Newton, damped, on sparse equations, with Cauchy's kernel on what
// was seen in images.

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace azimuth {

/// J dx = -e, each row whitened, and weighed where it is a sighting's.
struct FitEquations {
  Eigen::SparseMatrix<double> J;
  Eigen::VectorXd e;
  double cost = 0.0;                           ///< with the kernel
  std::vector<double> mahalanobis2, error_px;  ///< of each sighting; infinite, and NaN: the lens has no image of it
};

/// Beyond so many standard deviations a sighting counts less than half.
inline constexpr double kHalfWeight = 3.0;

/// Which sightings count in full, more or less, and the variance of what they leave in units of what was claimed.
/// `unknowns`: how many numbers they alone had to tell. 1 where nothing is left to judge by.
struct SightingWeights {
  std::vector<bool> fits;
  double unit_variance = 1.0;
};
SightingWeights weigh(const std::vector<double>& mahalanobis2, double unknowns);

/// Nothing: the damped information is singular.
std::optional<Eigen::VectorXd> damped_step(const FitEquations& equations, double damping);

/// Of the first `count` unknowns. Nothing: the information is singular.
std::optional<Eigen::MatrixXd> leading_covariance(const FitEquations& equations, Eigen::Index count);

template <class State>
struct Settled {
  State at;
  FitEquations equations;
};

/// From `at` to where the cost is least: `equations_at(state)` gives FitEquations, `moved(state, step)` the state a
/// step further. Nothing: what is there does not determine the unknowns. Deterministic.
template <class State, class EquationsAt, class Moved>
std::optional<Settled<State>> settled(State at, const EquationsAt& equations_at, const Moved& moved) {
  constexpr int kMostSteps = 60;
  constexpr double kSettled = 1e-9;  // relative decrease of the cost
  // What can be stretched together at next to no cost hardly moves by a step that is damped at all, so only one that is
  // not says that there is nothing left to gain.
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

/// What a sighting weighs whose error's square is that, in variances.
inline double cauchy_weight(double mahalanobis2) { return 1.0 / (1.0 + mahalanobis2 / (kHalfWeight * kHalfWeight)); }
inline double cauchy_cost(double mahalanobis2) {
  return 0.5 * kHalfWeight * kHalfWeight * std::log1p(mahalanobis2 / (kHalfWeight * kHalfWeight));
}
/// That of a sighting without an image.
inline double lost_cost() {
  constexpr double kGone2 = 1e4;
  return 0.5 * kHalfWeight * kHalfWeight * std::log1p(kGone2);
}

/// Root of the mean square of the errors that fit; 0: none does.
double rms_px(const std::vector<double>& error_px, const std::vector<bool>& fits);
/// Share of them; 0: there are none.
double share(const std::vector<bool>& fits);

}  // namespace azimuth
