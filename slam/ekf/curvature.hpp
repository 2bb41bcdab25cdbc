#pragma once
// What a linear update leaves out of a bearing.
//
// A bearing is the angle of a vector v that the state describes: from the robot to the landmark or, in the image, from
// the centre to the pixel. When v is off by dv, with a = across . dv / |v| and l = along . dv / |v|, its angle is off
// by
//
//   a - a l + ...
//
// The linear update knows a; a l is an error of every bearing whose v is uncertain in length. It is no noise: robot and
// centre are off by the same in all bearings of an image, so it does not average out, and a filter that believes its
// Jacobian gains from many precise bearings what none of them says, above all the scale of the map. Its second moment
// for Gaussian dv, var(a) var(l) + cov(a, l)^2, is charged to the bearing as noise of its own (the second-order filter
// of Jazwinski, "Stochastic processes and filtering theory", 1970, without its bias). It falls with the fourth power of
// what is unknown: once pose, centre and landmark are known, bearings count in full.
//
// The vector m = rho (anchor - p) + u(bearing) of a ray has a term of second order itself, d(rho) d(anchor - p), of
// which the part across counts likewise.

#include <Eigen/Core>
#include <cmath>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {

/// Second moment of the product of two Gaussian errors, less that of its mean.
inline double variance_of_product(double variance_a, double variance_b, double covariance) {
  return variance_a * variance_b + covariance * covariance;
}

/// Likewise of what two rows measure.
inline double variance_of_product(const JointState& state, const ObservationRow& a, const ObservationRow& b) {
  return variance_of_product(state.covariance(a, a), state.covariance(b, b), state.covariance(a, b));
}

/// What is left out of the angle [rad^2] of the pixel `p_px` seen from a centre whose place has this covariance.
inline double curvature_by_centre_rad2(const Eigen::Vector2d& p_px, const Eigen::Matrix2d& covariance_px2,
                                       double nearest_px) {
  const double r2 = std::max(p_px.squaredNorm(), nearest_px * nearest_px);
  const Eigen::Vector2d along = p_px / r2, across(-along.y(), along.x());
  return variance_of_product(across.dot(covariance_px2 * across), along.dot(covariance_px2 * along),
                             across.dot(covariance_px2 * along));
}

}  // namespace azimuth
