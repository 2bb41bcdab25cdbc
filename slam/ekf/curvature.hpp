#pragma once
// Noise charged for the second-order terms that a linear update of a bearing leaves out.
//
// A bearing is the angle of a vector v that the state describes: from the robot to the landmark or, in the image, from
// the centre to the pixel. For an error dv of v, let a = across . dv / |v| and l = along . dv / |v|. The error of the
// angle is
//
//   a - a l + ...
//
// The linear update models a. The term a l is an error of every bearing whose v is uncertain in length. It is not
// independent noise: the errors of robot and centre are the same in all bearings of an image, so they do not average
// out, and a filter that trusts its Jacobian gains information from many precise bearings that none of them carries,
// above all on the scale of the map. The second moment of a l for Gaussian dv, var(a) var(l) + cov(a, l)^2, is
// therefore added to the bearing's noise (the second-order filter of Jazwinski, "Stochastic processes and filtering
// theory", 1970, without its bias). It falls with the fourth power of the uncertainty: once pose, centre and landmark
// are known, bearings count in full.
//
// For a ray, the vector m = rho (anchor - p) + u(bearing) has a second-order term of its own, d(rho) d(anchor - p),
// whose part across m is charged in the same way.

#include <Eigen/Core>
#include <cmath>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {

/// Variance of the product of two zero-mean Gaussian errors.
inline double variance_of_product(double variance_a, double variance_b, double covariance) {
  return variance_a * variance_b + covariance * covariance;
}

/// Variance of the product of the errors of two rows' measurements.
inline double variance_of_product(const JointState& state, const ObservationRow& a, const ObservationRow& b) {
  return variance_of_product(state.covariance(a, a), state.covariance(b, b), state.covariance(a, b));
}

/// Second-order variance of the angle [rad^2] of the pixel `p_px` relative to a centre with this covariance.
inline double curvature_by_centre_rad2(const Eigen::Vector2d& p_px, const Eigen::Matrix2d& covariance_px2,
                                       double nearest_px) {
  const double r2 = std::max(p_px.squaredNorm(), nearest_px * nearest_px);
  const Eigen::Vector2d along = p_px / r2, across(-along.y(), along.x());
  return variance_of_product(across.dot(covariance_px2 * across), along.dot(covariance_px2 * along),
                             across.dot(covariance_px2 * along));
}

}  // namespace azimuth
