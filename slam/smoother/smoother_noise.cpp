// Noise estimates from residuals by variance components (Foerstner 1979). The traces are estimated with random signs.

#include <algorithm>
#include <cmath>

#include "slam/smoother/smoother.hpp"

namespace azimuth {
namespace {

constexpr int kProbes = 4;
constexpr double kFewestTold = 8.0;  // least redundancy for an estimate
constexpr double kLeast = 0.1, kMost = 10.0;
constexpr double kLeastShareTold = 1e-9;  // of the curvature; less is rounding

/// Expected weighted squared residual of standard Gaussian noise within the scatter bound. It is below one, since the
/// kernel also reduces the weight of a Gaussian's tails.
double expected_chi2(RobustKernel kernel, double width) {
  constexpr double kStep = 0.01;
  const double end = std::sqrt(kScattersChi2);
  double sum = 0.0, whole = 0.0;
  for (double r = 0.5 * kStep; r < end; r += kStep) {
    const double density = std::exp(-0.5 * r * r);
    whole += density;
    sum += density * kernel_value(kernel, width, r * r).weight * r * r;
  }
  return sum / whole;
}

Smoother::Noise noise_by(double chi2, double told) {
  if (!(told > kFewestTold)) return {};
  return {.ratio = std::clamp(std::sqrt(chi2 / told), kLeast, kMost), .told = told};
}

}  // namespace

/// Number of the residuals in `signed_sum` that the unknowns take up, estimated with random signs.
template <typename SignedSum>
double Smoother::taken_up(const SignedSum& signed_sum) const {
  double taken = 0.0;
  for (std::uint64_t seed = 0; seed < kProbes; ++seed) {
    Eigen::VectorXd sum = signed_sum(seed);
    factor_.forwards(sum);
    taken += sum.squaredNorm() / kProbes;
  }
  return taken;
}

Smoother::Noise Smoother::bearing_noise() const {
  const BearingGraph::Misfit misfit = graph_.misfit_of_bearings();
  const double taken = taken_up([this](std::uint64_t seed) { return graph_.signed_sum_of_bearings(seed); });
  return noise_by(misfit.chi2 / expected_chi2(settings_.kernel, settings_.kernel_width), misfit.residuals - taken);
}

Smoother::Noise Smoother::odometry_noise(int stride) const {
  const BearingGraph::Misfit misfit = graph_.misfit_of_odometry(stride);
  const double taken =
      taken_up([this, stride](std::uint64_t seed) { return graph_.signed_sum_of_odometry(seed, stride); });
  return noise_by(misfit.chi2, misfit.residuals - taken);
}

/// The unknowns follow the rig's errors; what they take up of the curvature tells nothing (Schur complement). It is
/// nearly all of it, so the factor must be exact, and what is left of the gradient counts.
RigEvidence<kCalibrations> Smoother::rig_evidence() const {
  Smoother exact = *this;
  exact.start_factor_anew();
  exact.optimise(0);
  BearingGraph::ByCalibration by = exact.graph_.by_calibration();
  Eigen::VectorXd gradient = exact.graph_.gradient();
  exact.factor_.forwards(gradient);
  for (int i = 0; i < kCalibrations; ++i) {
    if (!(by.curvature(i, i) > 0.0)) continue;
    Eigen::VectorXd column = by.mixed.col(i);
    exact.factor_.forwards(column);
    by.mixed.col(i) = column;
  }
  RigEvidence<kCalibrations> evidence{.information = by.curvature - by.mixed.transpose() * by.mixed,
                                      .pull = by.mixed.transpose() * gradient - by.slope};
  for (int i = 0; i < kCalibrations; ++i) {
    if (evidence.information(i, i) > kLeastShareTold * by.curvature(i, i)) continue;
    evidence.information.row(i).setZero();
    evidence.information.col(i).setZero();
    evidence.pull[i] = 0.0;
  }
  return evidence;
}

void Smoother::scale_noise(double bearings, double odometry) {
  graph_.scale_noise(bearings, odometry);
  factor_.mark_all_stale();
}

}  // namespace azimuth
