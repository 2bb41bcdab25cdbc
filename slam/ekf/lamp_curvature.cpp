#include "slam/ekf/lamp_curvature.hpp"

#include <cmath>

#include "slam/ekf/curvature.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kStraightUp = 1e-3;  // sine of the zenith angle below which across and along are undefined

}  // namespace

ObservationRow along(const Eigen::RowVector2d& by_offset, const PredictedLamp& predicted) {
  const auto& [x, y] = predicted.rows;
  ObservationRow row = x;
  for (std::size_t p = 0; p < as_size(x.count); ++p)
    for (std::size_t i = 0; i < x.parts[p].coefficients.size(); ++i)
      row.parts[p].coefficients[i] =
          by_offset(0) * x.parts[p].coefficients[i] + by_offset(1) * y.parts[p].coefficients[i];
  return row;
}

Eigen::Vector2d lens_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance) {
  const Eigen::Matrix2d by_centre = seen.by_camera.leftCols<2>(), P = covariance.topLeftCorner<2, 2>();
  const double a = by_centre.row(0).norm(), b = by_centre.row(1).norm();
  const double sine = seen.direction.zenith_sine(), cosine = seen.direction.zenith_cosine();
  if (!(a > 0.0) || !(b > 0.0) || sine < kStraightUp) return Eigen::Vector2d::Zero();
  const double by_radius = a / sine;
  const Eigen::RowVector2d x = by_centre.row(0) / a, y = by_centre.row(1) / b;
  const double xx = x * P * x.transpose(), yy = y * P * y.transpose(), xy = x * P * y.transpose();
  const double across = (b * cosine - a) * by_radius, along = 0.5 * (b - a * cosine) * by_radius;
  return {across * across * variance_of_product(xx, yy, xy), along * along * variance_of_product(xx, xx, xx)};
}

Eigen::Vector2d offset_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance) {
  const Eigen::Matrix2d P = seen.covariance_by_camera(covariance);
  const double tangent = seen.direction.zenith_sine() / seen.direction.zenith_cosine();
  return tangent * tangent *
         Eigen::Vector2d(variance_of_product(P(0, 0), P(1, 1), P(0, 1)),
                         variance_of_product(P(1, 1), P(1, 1), P(1, 1)));
}

Eigen::Vector2d LampEkf::curvature(const MappedLampSighting& sighting, const PredictedLamp& predicted,
                                   const TangentDirection::Residual& residual) const {
  if (!model_.charge_curvature) return Eigen::Vector2d::Zero();
  const Index lamp = sighting.lamp.block;
  ObservationRow stretch = along(residual.stretch, predicted);
  if (sighting.lamp.kind == BlockKind::point3)
    stretch.parts[1].coefficients[2] += 1.0 / (state_.mean(lamp + 2) - model_.camera_height_m);
  ObservationRow inverse_height;
  const double one = 1.0;
  inverse_height.add(lamp + 4, {&one, 1});
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  for (Index axis = 0; axis < 2; ++axis) {
    const Eigen::RowVector2d by_offset = residual.by_offset.row(axis);
    variance(axis) = variance_of_product(state_, along(by_offset, predicted), stretch);
    if (sighting.lamp.kind != BlockKind::inverse_height) continue;
    const Eigen::RowVector2d by_anchor = by_offset * to_body(state_.pose().heading_rad), by_robot = -by_anchor;
    ObservationRow shift;
    shift.add(lamp, {by_anchor.data(), 2});
    shift.add(JointState::kPose, {by_robot.data(), 2});
    variance(axis) += variance_of_product(state_, shift, inverse_height);
  }
  if (const auto errors = camera_errors()) variance += lens_curvature(sighting.seen, errors->covariance);
  return variance;
}

}  // namespace azimuth
