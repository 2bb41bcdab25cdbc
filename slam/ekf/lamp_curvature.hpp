#pragma once
// Noise charged for the second-order terms that a linear update of a lamp's direction leaves out; see curvature.hpp for
// the reason.
//
// The lamp. In the plane tangent to the sphere at the measured direction, M = (m, 1) appears at d_k = (axis_k . M) /
// (towards . M). For an error dM of M and its relative change in length s = towards . dM / |M|, the error of d_k is
// d_k - d_k s, of which the linear update models d_k. m itself (lamp_model.hpp) has the second-order terms
//   for a point, with dz the relative error of its height:  -dm dz, so that s grows by dz
//   for an inverse height:                                  dw R^T (da - dp)
//
// The lens. At the image radius r with the zenith angle t, let b = dt/dr, and let a = sin(t) / r be the factor from a
// step across to an angle. An error (x across, y along) [px] of the centre moves the direction by (a x, b y), and in
// second order by
//   across  (b cos t - a) / r x y,    along  (b - a cos t) / (2 r) x^2
// Both vanish in the middle of the image.
//
// The offset g of a new lamp, stored from its first observation: for an error (c, l) of the direction, the error of the
// offset is the linear term times 1 + l tan t.

#include <Eigen/Core>

#include "slam/ekf/lamp_ekf.hpp"

namespace azimuth {

/// The row of by_offset . m for a predicted lamp.
ObservationRow along(const Eigen::RowVector2d& by_offset, const PredictedLamp& predicted);

/// Variances of (across, along) [rad^2]: lens_curvature() for an uncertain centre, offset_curvature() for all camera
/// errors. `covariance` is laid out as in CameraErrors.
Eigen::Vector2d lens_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance);
Eigen::Vector2d offset_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance);

}  // namespace azimuth
