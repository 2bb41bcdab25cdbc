#pragma once
#include <Eigen/Core>

namespace azimuth {

/// Eigenvalues and eigenvectors of a symmetric matrix, such as a covariance; only the lower triangle is read. The
/// functions are compiled once here, since each size of Eigen's solver takes seconds to compile.
struct PrincipalAxes {
  Eigen::Vector2d eigenvalues;  ///< ascending
  Eigen::Matrix2d directions;   ///< unit eigenvectors, one per column
};

/// Thread contract: reentrant.
PrincipalAxes principal_axes(const Eigen::Matrix2d& symmetric);
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric);  ///< ascending

}  // namespace azimuth
