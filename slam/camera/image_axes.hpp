#pragma once
// Where azimuths are in the image of a camera whose optical axis is vertical. This alone serves a robot that only wants
// azimuths: neither the shape of a mirror nor radial distortion matter for them (SPEC I.5).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

/// A point in the image: u to the right, v down; whole numbers are the centres of pixels [px].
using Pixel = Eigen::Vector2d;

/// A pixel in polar coordinates about the optical axis.
struct PolarPixel {
  double radius_px = 0.0;
  double azimuth_rad = 0.0;  ///< in the robot's frame, [-pi, pi); arbitrary at the centre
};

/// u = u0 + r cos psi, v = beta (v0 + r sin psi), azimuth = direction * psi + offset   (SPEC I.5, II.2)
///
/// Thread contract: reentrant.
struct ImageAxes {
  Pixel centre_px = Pixel::Zero();  ///< (u0, v0); v0 in pixels as wide as high, so that beta applies to it as well
  double beta = 1.0;                ///< height of a pixel over its width, positive
  int azimuth_direction = -1;       ///< 1 or -1; -1: clockwise in the image is counter-clockwise about the robot
  double azimuth_offset_rad = 0.0;  ///< azimuth of the image's u axis

  /// Nearer to the centre than this, pixels say little of the azimuth: its uncertainty is taken from here.
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

  /// d (azimuth, radius) / d (u, v), with the radius below the azimuth's denominator at least kNearCentre_px.
  Eigen::Matrix2d polar_jacobian(const Pixel& pixel) const {
    const Eigen::Vector2d from_centre = square(pixel);
    const double radius_px = from_centre.norm();
    const double cos = radius_px > 0.0 ? from_centre.x() / radius_px : 1.0;
    const double sin = radius_px > 0.0 ? from_centre.y() / radius_px : 0.0;
    const double turn = azimuth_direction / std::max(radius_px, kNearCentre_px);
    return Eigen::Matrix2d{{-turn * sin, turn * cos / beta}, {cos, sin / beta}};
  }

 private:
  /// From the centre, in pixels as wide as high.
  Eigen::Vector2d square(const Pixel& pixel) const {
    return {pixel.x() - centre_px.x(), pixel.y() / beta - centre_px.y()};
  }
};

}  // namespace azimuth
