#pragma once
#include <Eigen/Core>

namespace azimuth {

/// Of a symmetric matrix, such as a covariance; only its lower triangle is read. Here and not at each use, since the
/// compiler takes ten seconds, with sanitizers a minute, over each size of Eigen's solver.
struct PrincipalAxes {
  Eigen::Vector2d eigenvalues;  ///< ascending
  Eigen::Matrix2d directions;   ///< unit vectors, one a column
};

/// Thread contract: reentrant.
PrincipalAxes principal_axes(const Eigen::Matrix2d& symmetric);
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric);  ///< ascending

}  // namespace azimuth
