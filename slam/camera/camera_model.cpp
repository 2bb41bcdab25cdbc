#include "slam/camera/camera_model.hpp"

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

CameraModel::CameraModel(const ImageAxes& axes, const RadialProfile& profile) : axes_(axes), profile_(profile) {
  assert(!problem(axes, profile));
}

std::optional<ElevationAt> CameraModel::elevation_at(double radius_px) const {
  return std::visit([&](const auto& shape) { return shape.elevation_at(radius_px); }, profile_);
}

std::optional<Direction> CameraModel::direction(const Pixel& pixel) const {
  const PolarPixel polar = axes_.polar(pixel);
  const std::optional<ElevationAt> at = elevation_at(polar.radius_px);
  if (!at) return std::nullopt;
  return Direction{polar.azimuth_rad, at->elevation_rad};
}

std::optional<Eigen::Vector3d> CameraModel::ray(const Pixel& pixel) const {
  const std::optional<Direction> seen = direction(pixel);
  return seen ? std::optional(azimuth::ray(*seen)) : std::nullopt;
}

std::optional<Pixel> CameraModel::pixel(const Direction& direction) const {
  const std::optional<double> radius_px =
      std::visit([&](const auto& shape) { return shape.radius_px(direction.elevation_rad); }, profile_);
  if (!radius_px) return std::nullopt;
  return axes_.pixel({*radius_px, direction.azimuth_rad});
}

std::optional<Pixel> CameraModel::pixel(const Eigen::Vector3d& ray) const { return pixel(azimuth::direction(ray)); }

/* azimuth = azimuth(u, v), elevation = elevation(r(u, v)):
 *   J = [1, 0; 0, d elevation / d r] * d (azimuth, r) / d (u, v)
 */
std::optional<Eigen::Matrix2d> CameraModel::direction_jacobian(const Pixel& pixel) const {
  const std::optional<ElevationAt> at = elevation_at(axes_.polar(pixel).radius_px);
  if (!at) return std::nullopt;
  Eigen::Matrix2d jacobian = axes_.polar_jacobian(pixel);
  jacobian.row(1) *= at->slope_rad_per_px;
  return jacobian;
}

std::optional<Eigen::Matrix2d> CameraModel::direction_covariance(const Pixel& pixel, double sigma_px) const {
  const std::optional<Eigen::Matrix2d> jacobian = direction_jacobian(pixel);
  if (!jacobian) return std::nullopt;
  return Eigen::Matrix2d(sigma_px * sigma_px * *jacobian * jacobian->transpose());
}

}  // namespace azimuth
