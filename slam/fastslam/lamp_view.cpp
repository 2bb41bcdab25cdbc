#include "slam/fastslam/lamp_view.hpp"

namespace azimuth {

LampSighting make_sighting(double azimuth_rad, double zenith_rad, const Symmetric2& covariance, Identity identity) {
  LampSighting seen;
  seen.azimuth_rad = azimuth_rad;
  seen.zenith_rad = zenith_rad;
  seen.covariance = covariance;
  seen.identity = identity;
  seen.cos_azimuth = std::cos(azimuth_rad);
  seen.sin_azimuth = std::sin(azimuth_rad);
  seen.cos_zenith = std::cos(zenith_rad);
  seen.sin_zenith = std::sin(zenith_rad);
  seen.log_peak = log_normal(Eigen::Vector2d::Zero(), covariance);
  return seen;
}

Eigen::Matrix<double, 2, 3> LampView::H_x() const { return Eigen::Matrix<double, 2, 3>{{a, b, -1.0}, {c, d, 0.0}}; }

Eigen::Matrix<double, 2, 3> LampView::H_m() const { return Eigen::Matrix<double, 2, 3>{{-a, -b, 0.0}, {-c, -d, e}}; }

Eigen::Vector2d direction_of(const LampView& view, double heading_rad) {
  return {wrap(std::atan2(view.dy_m, view.dx_m) - heading_rad), std::atan2(view.rho_m, view.dz_m)};
}

}  // namespace azimuth
