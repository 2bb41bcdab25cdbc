#include "slam/estimator/lamp_directions.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "slam/camera/make_camera.hpp"
#include "slam/estimator/rig_noise.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

std::optional<CameraModel> camera_model(const CameraRig& rig) {
  std::string problem;
  return camera_of(rig, problem);
}

/// The axes of the plane tangent to the unit sphere at `at`, as TangentDirection defines them.
Eigen::Matrix<double, 2, 3> across_and_along(const Direction& at) {
  const double cos = std::cos(at.azimuth_rad), sin = std::sin(at.azimuth_rad);
  const double up = std::sin(at.elevation_rad);
  return Eigen::Matrix<double, 2, 3>{{-sin, cos, 0.0}, {up * cos, up * sin, -std::cos(at.elevation_rad)}};
}

}  // namespace

LampDirections::LampDirections(const Rig& rig) : rig_(rig.camera), camera_(camera_model(rig.camera)) {}

/// Noise may move a lamp just outside of the image; it then gets the covariance at the rim.
Eigen::Matrix2d LampDirections::covariance(const Bearing& bearing) const {
  const double azimuth_rad = bearing.sigma_rad, elevation_rad = bearing.sigma_elevation_rad;
  if (std::isfinite(azimuth_rad) && std::isfinite(elevation_rad))
    return Eigen::Vector2d(azimuth_rad * azimuth_rad, elevation_rad * elevation_rad).asDiagonal();
  const ImageRig& image = rig_.image;
  if (camera_ && image.sigma_px) {
    const double rim_rad = kPi / 2.0 - image.theta_max_rad.value_or(kPi) + 1e-9;
    const Direction direction{bearing.azimuth_rad, std::max(bearing.elevation_rad, rim_rad)};
    if (const auto pixel = camera_->pixel(direction))
      if (const auto covariance = camera_->direction_covariance(*pixel, *image.sigma_px)) return *covariance;
  }
  const double sigma = sigma_rad(bearing, rig_);
  return Eigen::Vector2d(sigma * sigma, rig_.sigma_bearing_rad * rig_.sigma_bearing_rad).asDiagonal();
}

CameraModel LampDirections::leaning(const Eigen::Vector4d& errors) const {
  return {camera_->axes(),
          camera_->profile(),
          {camera_->tilt().roll_rad + errors(2), camera_->tilt().pitch_rad + errors(3)}};
}

/// A camera whose centre is off by e sees pixel q in the direction of q - e. With J = d(azimuth, elevation) / dq the
/// direction moves by (across, along) = (-sin(zenith) J_azimuth, J_elevation) de.
LampSeen LampDirections::seen(const Bearing& bearing, const Eigen::Vector4d& errors) const {
  Direction direction{bearing.azimuth_rad, bearing.elevation_rad};
  Eigen::Matrix2d by_pixel = Eigen::Matrix2d::Zero(), by_tilt = Eigen::Matrix2d::Zero();
  if (const auto pixel = camera_ ? camera_->pixel(direction) : std::nullopt) {
    const CameraModel camera = leaning(errors);
    const Pixel moved = *pixel - errors.head<2>();
    const auto corrected = camera.direction(moved);
    const auto jacobian = camera.direction_jacobian(moved);
    if (corrected && jacobian) {
      direction = *corrected;
      by_pixel = *jacobian;
      by_tilt = across_and_along(direction) * camera.tilt().by_tilt(ray(direction));
    }
  }
  const double zenith_rad = kPi / 2.0 - direction.elevation_rad;
  const Eigen::Vector2d variance_rad2 = covariance(bearing).diagonal();
  LampSeen seen{TangentDirection(wrap(direction.azimuth_rad + rig_.yaw_offset_rad), zenith_rad, variance_rad2)};
  seen.by_camera.leftCols<2>() << -std::sin(zenith_rad) * by_pixel.row(0), by_pixel.row(1);
  seen.by_camera.rightCols<2>() = by_tilt;
  return seen;
}

Direction LampDirections::shown(const Direction& direction, const Eigen::Vector4d& errors) const {
  const Direction in_camera{wrap(direction.azimuth_rad - rig_.yaw_offset_rad), direction.elevation_rad};
  const auto pixel = camera_ ? leaning(errors).pixel(in_camera) : std::nullopt;
  const auto shown = pixel ? camera_->direction(*pixel + errors.head<2>()) : std::nullopt;
  return shown.value_or(in_camera);
}

}  // namespace azimuth
