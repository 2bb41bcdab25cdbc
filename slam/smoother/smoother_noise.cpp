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

/// The unknowns follow the yaw; what they take up of its curvature tells nothing (Schur complement).
Smoother::Told Smoother::camera_yaw_rad() const {
  BearingGraph::ByYaw by = graph_.by_yaw();
  factor_.forwards(by.mixed);
  const double information = by.curvature - by.mixed.squaredNorm();
  if (!(information > kLeastShareTold * by.curvature)) return {};
  return {.value = -by.slope / information, .information = information};
}

void Smoother::scale_noise(double bearings, double odometry) {
  graph_.scale_noise(bearings, odometry);
  factor_.mark_all_stale();
}

}  // namespace azimuth
