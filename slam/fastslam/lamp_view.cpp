#include "slam/fastslam/lamp_view.hpp"

namespace azimuth {

LampSighting make_sighting(double azimuth_rad, double zenith_rad, const Symmetric2& covariance, Identity identity) {
  LampSighting seen;
  seen.azimuth_rad = azimuth_rad;
  seen.zenith_rad = zenith_rad;
  seen.covariance = covariance;
  seen.identity = identity;
  seen.cosine = Both{std::cos(azimuth_rad), std::cos(zenith_rad)};
  seen.sine = Both{std::sin(azimuth_rad), std::sin(zenith_rad)};
  seen.log_peak = log_normal(Eigen::Vector2d::Zero(), covariance);
  return seen;
}

Eigen::Vector2d direction_of(const LampView& view, double heading_rad) {
  return {wrap(std::atan2(view.dy_m, view.dx_m) - heading_rad), std::atan2(view.rho_m, view.dz_m)};
}

}  // namespace azimuth
