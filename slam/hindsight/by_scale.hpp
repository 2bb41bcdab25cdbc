#pragma once
#include <Eigen/Core>

namespace azimuth {

/// Covariance that an error in the scale of all distances adds to a position; `sigma_scale` is the standard deviation
/// of the scale. Bearings cannot reveal this error: a larger map with a longer path gives the same bearings. The error
/// moves each position away from the map's origin in proportion to its distance.
inline Eigen::Matrix2d by_scale(double sigma_scale, const Eigen::Vector2d& p_map) {
  return sigma_scale * sigma_scale * p_map * p_map.transpose();
}

}  // namespace azimuth
