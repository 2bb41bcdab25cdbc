#pragma once
// Derivatives of a vector function by Richardson-extrapolated central differences, for tests of analytic Jacobians.

#include <Eigen/Core>
#include <initializer_list>

#include "slam/geometry/angle.hpp"

namespace azimuth {

/// df/dx at `x`. Differences of the outputs listed in `angles` are wrapped. With a step of 1e-3 the error is of the
/// order 1e-12 times the fifth derivative: keep denominators of the function (distances, sines) above about 0.2.
template <class Function>
Eigen::MatrixXd numeric_jacobian(const Function& f, const Eigen::VectorXd& x,
                                 std::initializer_list<Eigen::Index> angles = {}, double step = 1e-3) {
  const auto central = [&](Eigen::Index entry, double h) {
    Eigen::VectorXd ahead = x, behind = x;
    ahead(entry) += h;
    behind(entry) -= h;
    Eigen::VectorXd difference = Eigen::VectorXd(f(ahead)) - Eigen::VectorXd(f(behind));
    for (const Eigen::Index angle : angles) difference(angle) = wrap(difference(angle));
    return Eigen::VectorXd(difference / (2.0 * h));
  };
  Eigen::MatrixXd jacobian;
  for (Eigen::Index entry = 0; entry < x.size(); ++entry) {
    const Eigen::VectorXd column = (4.0 * central(entry, step / 2.0) - central(entry, step)) / 3.0;
    if (entry == 0) jacobian.resize(column.size(), x.size());
    jacobian.col(entry) = column;
  }
  return jacobian;
}

/// The largest |a - b| / (1 + |b|), a relative and absolute difference in one.
inline double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return ((a - b).cwiseAbs().array() / (1.0 + b.cwiseAbs().array())).maxCoeff();
}

/// Tolerance for the difference between analytic and numeric Jacobians.
inline constexpr double kJacobianTolerance = 1e-6;

}  // namespace azimuth
