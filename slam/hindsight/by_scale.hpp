#pragma once
#include <Eigen/Core>

namespace azimuth {

/// What an error of the scale of all distances adds to the covariance of a place, `sigma_scale` being its standard
/// deviation. A map twice as large, driven through twice as far, looks the same: such an error moves everything away
/// from where the map begins, in proportion.
inline Eigen::Matrix2d by_scale(double sigma_scale, const Eigen::Vector2d& p_map) {
  return sigma_scale * sigma_scale * p_map * p_map.transpose();
}

}  // namespace azimuth
