#pragma once
// What a linear update leaves out of a direction to a lamp; see curvature.hpp for why it is charged as noise.
//
// The lamp. In the plane that touches the sphere where the lamp was seen, M = (m, 1) shows at d_k = (axis_k . M) /
// (towards . M). With dM the error of M, and s = towards . dM / |M| how much longer it gets, d_k is off by
// d_k - d_k s, of which the linear update knows d_k. Of m itself (lamp_model.hpp) the terms of second order are
//   of a point, with dz the error of its height over its height:  -dm dz, so that s grows by dz
//   of an inverse height:                                          dw R^T (da - dp)
//
// The lens. At the radius r and the zenith angle t it shows, with b = dt/dr, and a = sin(t) / r what turns a step
// across into an angle: a centre that is off by (x across, y along) [px] moves the direction by (a x, b y) and besides
// by
//   across  (b cos t - a) / r x y,    along  (b - a cos t) / (2 r) x^2
// which both vanish in the middle of the image, as they must.
//
// The offset g of a new lamp, kept from its first sighting: a direction off by (c, l) has its offset off by the linear
// term times 1 + l tan t.

#include <Eigen/Core>

#include "slam/ekf/lamp_ekf.hpp"

namespace azimuth {

/// by_offset . (the rows of m) of a predicted lamp.
ObservationRow along(const Eigen::RowVector2d& by_offset, const PredictedLamp& predicted);

/// Variances of (across, along) [rad^2] by an uncertain centre, and by all that is uncertain of the camera.
/// `covariance` as in CameraErrors.
Eigen::Vector2d lens_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance);
Eigen::Vector2d offset_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance);

}  // namespace azimuth
