// Where the lamp EKF expects to see its lamps.

#include <cmath>

#include "slam/estimator/lamp_ekf_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kAtTheZenith = 1e-6;  // in metres per metre of height: the azimuth means nothing

/// Rows: d azimuth / dm and d zenith angle / dm.
Eigen::Matrix2d angles_by_offset(const Eigen::Vector2d& m) {
  const double m2 = m.squaredNorm(), length = std::sqrt(m2);
  return Eigen::Matrix2d{{-m.y() / m2, m.x() / m2}, {m.x() / (length * (1.0 + m2)), m.y() / (length * (1.0 + m2))}};
}

}  // namespace

/// All that is above the camera. The gates of both angles bound the ellipse in which a direction is taken for the lamp.
void LampEkfEstimator::expect(std::vector<ExpectedBearing>& out) const {
  out.clear();
  for (const Lamp& lamp : lamps_) {
    const auto predicted = ekf_.predict(lamp.at);
    if (!predicted || !(predicted->m.norm() > kAtTheZenith)) continue;
    const Eigen::Vector2d& m = predicted->m;
    const Direction direction{std::atan2(m.y(), m.x()), kPi / 2.0 - std::atan(m.norm())};
    const Direction shown = directions_.shown(direction, centre_or_exact().mean_px);
    const Eigen::Matrix2d by_m = angles_by_offset(m);
    const Eigen::Matrix2d S =
        by_m * ekf_.covariance(*predicted, *predicted) * by_m.transpose() +
        directions_.covariance({.azimuth_rad = shown.azimuth_rad, .elevation_rad = shown.elevation_rad});
    out.push_back({.landmark = lamp.id,
                   .azimuth_rad = shown.azimuth_rad,
                   .gate_rad = std::sqrt(settings_.gate_chi2 * S(0, 0)),
                   .elevation_rad = shown.elevation_rad,
                   .gate_elevation_rad = std::sqrt(settings_.gate_chi2 * S(1, 1))});
  }
}

}  // namespace azimuth
