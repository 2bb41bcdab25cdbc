#include "slam/camera/camera_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {

Eigen::Vector3d ray(const Direction& direction) {
  const double out = std::cos(direction.elevation_rad);
  return {out * std::cos(direction.azimuth_rad), out * std::sin(direction.azimuth_rad),
          std::sin(direction.elevation_rad)};
}

Direction direction(const Eigen::Vector3d& ray) {
  return {wrap(std::atan2(ray.y(), ray.x())), std::atan2(ray.z(), hypotenuse(ray.x(), ray.y()))};
}

std::optional<std::string_view> CameraModel::problem(const ImageAxes& axes, const RadialProfile& profile) {
  if (!axes.centre_px.allFinite() || !std::isfinite(axes.azimuth_offset_rad)) return "centre and offset must be finite";
  if (!(axes.beta > 0.0 && std::isfinite(axes.beta))) return "beta must be positive";
  if (axes.azimuth_direction != 1 && axes.azimuth_direction != -1) return "the azimuth's direction must be 1 or -1";
  return std::visit([](const auto& shape) { return shape.problem(); }, profile);
}

CameraModel::CameraModel(const ImageAxes& axes, const RadialProfile& profile, const CameraTilt& tilt)
    : axes_(axes), profile_(profile), tilt_(tilt), R_level_camera_(tilt.R_level_camera()) {
  assert(!problem(axes, profile));
}

std::optional<ElevationAt> CameraModel::elevation_at(double radius_px) const {
  return std::visit([&](const auto& shape) { return shape.elevation_at(radius_px); }, profile_);
}

std::optional<Direction> CameraModel::in_camera(const Pixel& pixel) const {
  const PolarPixel polar = axes_.polar(pixel);
  const std::optional<ElevationAt> at = elevation_at(polar.radius_px);
  if (!at) return std::nullopt;
  return Direction{polar.azimuth_rad, at->elevation_rad};
}

std::optional<Pixel> CameraModel::pixel_in_camera(const Direction& in_camera) const {
  const std::optional<double> radius_px =
      std::visit([&](const auto& shape) { return shape.radius_px(in_camera.elevation_rad); }, profile_);
  if (!radius_px) return std::nullopt;
  return axes_.pixel({*radius_px, in_camera.azimuth_rad});
}

Direction CameraModel::levelled(const Direction& in_camera) const {
  if (is_level()) return in_camera;
  return azimuth::direction(Eigen::Vector3d(R_level_camera_ * azimuth::ray(in_camera)));
}

std::optional<Direction> CameraModel::direction(const Pixel& pixel) const {
  const std::optional<Direction> seen = in_camera(pixel);
  return seen ? std::optional(levelled(*seen)) : std::nullopt;
}

std::optional<Eigen::Vector3d> CameraModel::ray(const Pixel& pixel) const {
  const std::optional<Direction> seen = direction(pixel);
  return seen ? std::optional(azimuth::ray(*seen)) : std::nullopt;
}

std::optional<Pixel> CameraModel::pixel(const Direction& direction) const {
  if (is_level()) return pixel_in_camera(direction);
  return pixel_in_camera(azimuth::direction(Eigen::Vector3d(R_level_camera_.transpose() * azimuth::ray(direction))));
}

std::optional<Pixel> CameraModel::pixel(const Eigen::Vector3d& ray) const { return pixel(azimuth::direction(ray)); }

std::optional<Pixel> CameraModel::level_pixel(const Pixel& pixel) const {
  if (is_level()) return pixel;
  const std::optional<Direction> seen = direction(pixel);
  return seen ? pixel_in_camera(*seen) : std::nullopt;
}

std::optional<Pixel> CameraModel::tilted_pixel(const Pixel& level_pixel) const {
  if (is_level()) return level_pixel;
  const std::optional<Direction> seen = in_camera(level_pixel);
  return seen ? pixel(*seen) : std::nullopt;
}

/* azimuth = azimuth(u, v), elevation = elevation(r(u, v)):
 *   J = [1, 0; 0, d elevation / d r] * d (azimuth, r) / d (u, v)
 */
std::optional<Eigen::Matrix2d> CameraModel::direction_jacobian(const Pixel& pixel) const {
  const std::optional<ElevationAt> at = elevation_at(axes_.polar(pixel).radius_px);
  if (!at) return std::nullopt;
  if (!is_level()) return levelled_jacobian(pixel, *at);
  Eigen::Matrix2d jacobian = axes_.polar_jacobian(pixel);
  jacobian.row(1) *= at->slope_rad_per_px;
  return jacobian;
}

/* A direction moves on the sphere, eastwards by cos(elevation) d azimuth and upwards by d elevation; the tilt rotates
 * these tangents (mathematics VI.34). Unlike azimuths, they have no singularity:
 *   d ray = (east, up)_camera diag(cos(elevation) / r, d elevation / d r) d (r psi, r),
 *   d (cos(elevation) azimuth, elevation)_level = (east, up)_level^T R d ray
 */
Eigen::Matrix2d CameraModel::levelled_jacobian(const Pixel& pixel, const ElevationAt& at) const {
  const auto tangents = [](const Direction& at_direction) {
    const double cos = std::cos(at_direction.azimuth_rad), sin = std::sin(at_direction.azimuth_rad);
    const double out = std::cos(at_direction.elevation_rad), up = std::sin(at_direction.elevation_rad);
    return Eigen::Matrix<double, 3, 2>{{-sin, -up * cos}, {cos, -up * sin}, {0.0, out}};
  };
  const PolarPixel polar = axes_.polar(pixel);
  const Direction in_camera{polar.azimuth_rad, at.elevation_rad}, level = levelled(in_camera);
  const double slope = std::abs(at.slope_rad_per_px);
  Eigen::Matrix2d on_sphere = axes_.polar_jacobian(pixel);
  on_sphere.row(0) *= std::max(polar.radius_px, ImageAxes::kNearCentre_px);
  on_sphere.row(0) *= polar.radius_px > 1e-3 ? std::cos(at.elevation_rad) / polar.radius_px : slope;
  on_sphere.row(1) *= at.slope_rad_per_px;
  Eigen::Matrix2d jacobian = tangents(level).transpose() * (R_level_camera_ * (tangents(in_camera) * on_sphere));
  jacobian.row(0) /= std::max(std::cos(level.elevation_rad), slope * ImageAxes::kNearCentre_px);
  return jacobian;
}

std::optional<Eigen::Matrix2d> CameraModel::direction_covariance(const Pixel& pixel, double sigma_px) const {
  const std::optional<Eigen::Matrix2d> jacobian = direction_jacobian(pixel);
  if (!jacobian) return std::nullopt;
  return Eigen::Matrix2d(sigma_px * sigma_px * *jacobian * jacobian->transpose());
}

}  // namespace azimuth
