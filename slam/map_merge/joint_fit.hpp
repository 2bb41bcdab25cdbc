#pragma once
// Internal to slam/map_merge and its tests.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/map_merge/map_gaussian.hpp"

namespace azimuth {

/// gap = p_a - T_a_b p_b, which is zero for a landmark that both maps contain, and its derivatives by p_b and by T's
/// (x, y, heading). The derivative by p_a is the identity. Equation (1) of docs/mathematics.md, VI.30.
struct Gap {
  Eigen::Vector2d value_m;
  Eigen::Matrix2d by_p_b;
  Eigen::Matrix<double, 2, 3> by_T;
};
Gap gap(const Eigen::Vector2d& p_a, const Pose2& T_a_b, const Eigen::Vector2d& p_b);

/// The joint Gaussian of both maps and T_a_b, given that each pair is one landmark.
struct JointFit {
  bool sound = false;  ///< False if the pairs do not determine T_a_b
  std::vector<Correspondence> pairs;
  Pose2 T_a_b;
  Eigen::Matrix3d covariance_T = Eigen::Matrix3d::Zero();
  Eigen::VectorXd mean_a, mean_b;  ///< Rows as in the maps; mean_b is in b's frame
  double chi2 = 0.0;
  Eigen::Index rows = 0;  ///< Rows of the constraint; chi2 has three degrees of freedom fewer
  /// Log density of the gaps, with a prior on T_a_b that is uniform over one square metre and one radian
  double log_evidence = 0.0;

  // The posterior covariance in factors: P - U Q U', and -U S^-1 G C with T. See equations (4) to (6) of
  // docs/mathematics.md, VI.30, for the symbols.
  Eigen::MatrixXd U_a, U_b;
  Eigen::MatrixXd Q;
  Eigen::MatrixXd S_inverse_G;
  Eigen::VectorXd weighted_gap;      ///< Q times the gap
  std::vector<Eigen::Index> row_of;  ///< Of each pair: the first row of its constraint
};

/// Finds the most probable T_a_b and maps by Gauss-Newton from `start`.
JointFit fit_jointly(const MapGaussian& a, const MapGaussian& b, std::span<const Correspondence> pairs,
                     const Pose2& start);

/// The decrease of chi2 when pair `i` is left out, and the number of rows of a pair.
double chi2_of_pair(const JointFit& fit, std::size_t i);
Eigen::Index rows_of_pair(const MapGaussian& a, const MapGaussian& b, const Correspondence& pair);

/// Squared Mahalanobis distance, in the plane, of the gap of a pair that is not in the fit, given the fit.
double chi2_of_candidate(const MapGaussian& a, const MapGaussian& b, const JointFit& fit, const Correspondence& pair);

}  // namespace azimuth
