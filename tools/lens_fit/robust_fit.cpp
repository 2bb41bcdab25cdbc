#include "tools/lens_fit/robust_fit.hpp"

#include <Eigen/SparseCholesky>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLDLT<Sparse>;

Sparse information(const FitEquations& equations) { return Sparse(equations.J.transpose()) * equations.J; }

}  // namespace

SightingWeights weigh(const std::vector<double>& mahalanobis2, double unknowns) {
  SightingWeights found;
  double sum = 0.0, weights = 0.0;
  for (const double each : mahalanobis2) {
    const double weight = cauchy_weight(each);
    found.fits.push_back(weight >= 0.5);
    if (weight > 0.0) sum += weight * each;
    weights += weight;
  }
  const double left = 2.0 * weights - unknowns;
  if (left > 0.0) found.unit_variance = sum / left;
  return found;
}

std::optional<Eigen::VectorXd> damped_step(const FitEquations& equations, double damping) {
  Sparse A = information(equations);
  A.diagonal() += damping * A.diagonal();
  const Factor factor(A);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.solve(-(equations.J.transpose() * equations.e));
}

std::optional<Eigen::MatrixXd> leading_covariance(const FitEquations& equations, Eigen::Index count) {
  const Sparse A = information(equations);
  const Factor factor(A);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.0)) return std::nullopt;
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(A.rows(), count);
  units.topRows(count).setIdentity();
  const Eigen::MatrixXd covariance = Eigen::MatrixXd(factor.solve(units)).topRows(count);
  if (!covariance.allFinite()) return std::nullopt;
  return covariance;
}

double rms_px(const std::vector<double>& error_px, const std::vector<bool>& fits) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!fits[i]) continue;
    sum += error_px[i] * error_px[i];
    ++count;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

double share(const std::vector<bool>& fits) {
  const auto count = static_cast<double>(std::count(fits.begin(), fits.end(), true));
  return fits.empty() ? 0.0 : count / static_cast<double>(fits.size());
}

}  // namespace azimuth
