#include "slam/geometry/principal_axes.hpp"

#include <Eigen/Eigenvalues>

namespace azimuth {

PrincipalAxes principal_axes(const Eigen::Matrix2d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace azimuth
