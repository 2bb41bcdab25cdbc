#pragma once
// The mapping of pixels to azimuths for a camera with a vertical optical axis. Azimuths depend neither on the shape of
// a mirror nor on radial distortion, so this suffices for a robot that uses only azimuths (mathematics I.5).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

/// A point in the image: u to the right, v down; integer values are pixel centres [px].
using Pixel = Eigen::Vector2d;

/// A pixel in polar coordinates about the optical axis.
struct PolarPixel {
  double radius_px = 0.0;
  double azimuth_rad = 0.0;  ///< In the robot's frame, in [-pi, pi); arbitrary at the centre.
};

/// u = u0 + r cos psi, v = beta (v0 + r sin psi), azimuth = direction * psi + offset   (mathematics I.5, II.2)
///
/// Thread contract: reentrant.
struct ImageAxes {
  Pixel centre_px = Pixel::Zero();  ///< (u0, v0); v0 is in square pixels, so beta applies to it too.
  double beta = 1.0;                ///< Height of a pixel over its width; positive.
  int azimuth_direction = -1;       ///< 1 or -1; for -1, clockwise in the image is counter-clockwise about the robot.
  double azimuth_offset_rad = 0.0;  ///< Azimuth of the image's u axis

  /// Within this distance of the centre, pixels hardly constrain the azimuth; its uncertainty is taken at this
  /// distance.
  static constexpr double kNearCentre_px = 2.0;

  PolarPixel polar(const Pixel& pixel) const {
    const Eigen::Vector2d from_centre = square(pixel);
    return {from_centre.norm(), azimuth_rad(pixel)};
  }
  double azimuth_rad(const Pixel& pixel) const {
    const Eigen::Vector2d from_centre = square(pixel);
    return wrap(azimuth_direction * std::atan2(from_centre.y(), from_centre.x()) + azimuth_offset_rad);
  }
  Pixel pixel(const PolarPixel& polar) const {
    const double psi = azimuth_direction * (polar.azimuth_rad - azimuth_offset_rad);
    return {centre_px.x() + polar.radius_px * std::cos(psi), beta * (centre_px.y() + polar.radius_px * std::sin(psi))};
  }

  /// d (azimuth, radius) / d (u, v); the radius in the denominator of the azimuth's row is at least kNearCentre_px.
  Eigen::Matrix2d polar_jacobian(const Pixel& pixel) const {
    const Eigen::Vector2d from_centre = square(pixel);
    const double radius_px = from_centre.norm();
    const double cos = radius_px > 0.0 ? from_centre.x() / radius_px : 1.0;
    const double sin = radius_px > 0.0 ? from_centre.y() / radius_px : 0.0;
    const double turn = azimuth_direction / std::max(radius_px, kNearCentre_px);
    return Eigen::Matrix2d{{-turn * sin, turn * cos / beta}, {cos, sin / beta}};
  }

 private:
  /// Offset from the centre, in square pixels.
  Eigen::Vector2d square(const Pixel& pixel) const {
    return {pixel.x() - centre_px.x(), pixel.y() / beta - centre_px.y()};
  }
};

}  // namespace azimuth
