#pragma once
// Internal to slam/map_merge, and for its tests.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/map_merge/map_gaussian.hpp"

namespace azimuth {

/// gap = p_a - T_a_b p_b, which is zero of a landmark in both maps, and its derivatives by p_b and by T's (x, y,
/// heading); that by p_a is the identity. Equation (1) of docs/mathematics.md, VI.30.
struct Gap {
  Eigen::Vector2d value_m;
  Eigen::Matrix2d by_p_b;
  Eigen::Matrix<double, 2, 3> by_T;
};
Gap gap(const Eigen::Vector2d& p_a, const Pose2& T_a_b, const Eigen::Vector2d& p_b);

/// Both maps and T_a_b as one Gaussian, given that these pairs are one landmark each.
struct JointFit {
  bool sound = false;  ///< false: the pairs do not fix T_a_b
  std::vector<Correspondence> pairs;
  Pose2 T_a_b;
  Eigen::Matrix3d covariance_T = Eigen::Matrix3d::Zero();
  Eigen::VectorXd mean_a, mean_b;  ///< rows as in the maps; of b in b's frame
  double chi2 = 0.0;
  Eigen::Index rows = 0;      ///< of the constraint; chi2 has three degrees of freedom less
  double log_evidence = 0.0;  ///< density of the gaps, over all T_a_b of one metre squared and one radian

  // The posterior covariance in its factors, equations (4) to (6): P - U Q U', and -U S^-1 G C beside T.
  Eigen::MatrixXd U_a, U_b;
  Eigen::MatrixXd Q;
  Eigen::MatrixXd S_inverse_G;
  Eigen::VectorXd weighted_gap;      ///< Q times the gap
  std::vector<Eigen::Index> row_of;  ///< of each pair's constraint
};

/// The most probable T_a_b and maps, by Gauss-Newton from `start`.
JointFit fit_jointly(const MapGaussian& a, const MapGaussian& b, std::span<const Correspondence> pairs,
                     const Pose2& start);

/// By how much chi2 falls when pair `i` of the fit is left out, and the rows it has.
double chi2_of_pair(const JointFit& fit, std::size_t i);
Eigen::Index rows_of_pair(const MapGaussian& a, const MapGaussian& b, const Correspondence& pair);

/// Of the gap of a pair that is not among those of the fit, given the fit: squared, by its covariance, in the plane.
double chi2_of_candidate(const MapGaussian& a, const MapGaussian& b, const JointFit& fit, const Correspondence& pair);

}  // namespace azimuth
