#pragma once
// Concatenation and inversion of motions. Reentrant.

#include "slam/geometry/motion.hpp"

namespace azimuth {

/// `first`, then `second`, as one motion; the covariance is in the body frame at the start.
inline Motion chained(const Motion& first, const Motion& second) {
  const MovedPose moved = apply(first.T_start_end, second);
  return {moved.T_map_body,
          moved.G * first.covariance * moved.G.transpose() + moved.noise,
          first.path_m + second.path_m,
          first.turned_rad + second.turned_rad,
          moved.G * first.by_scales + moved.by_scales,
          moved.G * first.by_lag + moved.by_lag,
          moved.G * first.by_drift + moved.by_drift,
          second.velocity_at_end};
}

/* The inverse motion: T_end_start = T_start_end^-1, (x', y') = -R(-heading) (x, y), heading' = -heading, so
 *   d(T_end_start)/d(T_start_end) = [-R(-heading), (y', -x'); 0, -1] */
inline Motion reversed(const Motion& motion) {
  Motion back = motion;
  back.T_start_end = inverse(motion.T_start_end);
  const double c = std::cos(motion.T_start_end.heading_rad), s = std::sin(motion.T_start_end.heading_rad);
  Eigen::Matrix3d J;
  J << -c, -s, back.T_start_end.y_m, s, -c, -back.T_start_end.x_m, 0.0, 0.0, -1.0;
  back.covariance = J * motion.covariance * J.transpose();
  back.by_scales = J * motion.by_scales;
  back.by_lag = J * motion.by_lag;
  back.by_drift = J * motion.by_drift;
  return back;
}

}  // namespace azimuth
