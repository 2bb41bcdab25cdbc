#pragma once
// The radial profiles of mirrors and lenses: the mapping from radius in the image to elevation, for a camera with a
// vertical axis.
//
// Each profile P has
//   std::optional<std::string_view> P::problem() const           the reason why its parameters are invalid, or nullopt
//   std::optional<ElevationAt> P::elevation_at(radius_px) const  nullopt beyond the end of the image
//   std::optional<double> P::radius_px(elevation_rad) const      nullopt for directions that the camera cannot see
// The two mappings are inverse to each other, strictly monotone and smooth. All profiles are plain values. Thread
// contract: reentrant.

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "slam/geometry/angle.hpp"

namespace azimuth {

struct ElevationAt {
  double elevation_rad = 0.0;     ///< Up from the horizontal
  double slope_rad_per_px = 0.0;  ///< d elevation / d radius
};

/// A hyperbolic mirror z^2 / a^2 - r^2 / b^2 = 1 above a perspective camera that looks up into it. The camera's optical
/// centre is in one focus; the other focus, where the rays meet, is the viewpoint. The centre of the image looks
/// straight down.
struct HyperbolicMirror {
  double a_mm = 0.0;  ///< Only the ratio of a to b matters for directions
  double b_mm = 0.0;
  double focal_length_px = 0.0;

  std::optional<std::string_view> problem() const;
  std::optional<ElevationAt> elevation_at(double radius_px) const;
  std::optional<double> radius_px(double elevation_rad) const;
};

/// A parabolic mirror with a telecentric lens: r = h tan(pi/4 + elevation/2). The centre of the image looks straight
/// down.
struct ParabolicMirror {
  double horizon_radius_px = 0.0;  ///< h: the radius of the horizon, which is the mirror's focal parameter in pixels.

  std::optional<std::string_view> problem() const {
    if (!(horizon_radius_px > 0.0 && std::isfinite(horizon_radius_px))) return "the horizon's radius must be positive";
    return std::nullopt;
  }
  std::optional<ElevationAt> elevation_at(double radius_px) const {
    if (!(radius_px >= 0.0) || !std::isfinite(radius_px)) return std::nullopt;
    const double ratio = radius_px / horizon_radius_px;
    return ElevationAt{2.0 * std::atan(ratio) - kPi / 2.0, 2.0 / (horizon_radius_px * (1.0 + ratio * ratio))};
  }
  std::optional<double> radius_px(double elevation_rad) const {
    if (!(std::abs(elevation_rad) <= kPi / 2.0) || elevation_rad >= kHighest_rad) return std::nullopt;
    return horizon_radius_px * std::tan(kPi / 4.0 + elevation_rad / 2.0);
  }

 private:
  static constexpr double kHighest_rad = kPi / 2.0 - 1e-6;  // The zenith is at infinite radius
};

/// A fisheye that looks straight up, in the model of Bakstein and Pajdla: r = a tan(theta / b) + c sin(theta / d),
/// where theta is the angle from the optical axis and elevation = pi/2 - theta (mathematics II.2).
struct PajdlaFisheye {
  double a_px = 0.0;
  double b = 1.0;
  double c_px = 0.0;
  double d = 1.0;
  double theta_max_rad = 0.0;  ///< The model is valid up to this theta; r must grow strictly up to it.

  std::optional<std::string_view> problem() const;
  /// The elevation is exact to rounding; it is found by Newton's method, safeguarded by a bracket.
  std::optional<ElevationAt> elevation_at(double radius_px) const;
  std::optional<double> radius_px(double elevation_rad) const;

  double radius_at_px(double theta_rad) const;
  double radius_slope_px_per_rad(double theta_rad) const;  ///< d r / d theta
};

/// A fisheye that looks straight up: r = f theta, where theta is the angle from the optical axis and elevation = pi/2 -
/// theta.
struct EquidistantFisheye {
  double focal_length_px = 0.0;  ///< f, in pixels per radian
  double theta_max_rad = 0.0;    ///< The greatest theta that the lens sees

  std::optional<std::string_view> problem() const {
    if (!(focal_length_px > 0.0 && focal_length_px < 1e9)) return "the focal length must be positive";
    if (!(theta_max_rad > 0.0 && theta_max_rad <= kPi)) return "theta_max must be above 0 and at most pi";
    return std::nullopt;
  }
  std::optional<ElevationAt> elevation_at(double radius_px) const {
    const double theta = radius_px / focal_length_px;
    if (!(theta >= 0.0 && theta <= theta_max_rad)) return std::nullopt;
    return ElevationAt{kPi / 2.0 - theta, -1.0 / focal_length_px};
  }
  std::optional<double> radius_px(double elevation_rad) const {
    const double theta = kPi / 2.0 - elevation_rad;
    if (!(theta >= 0.0 && theta <= theta_max_rad)) return std::nullopt;
    return focal_length_px * theta;
  }
};

/// A fisheye that looks straight up, in the OCamCalib model (Scaramuzza): a pixel (x, y) at radius r from the centre
/// looks along (x, y, f(r)) with f(r) = a0 + a1 r + a2 r^2 + a3 r^3 + a4 r^4. The angle from the optical axis is theta
/// = atan2(r, -f(r)), and elevation = pi/2 - theta. a0 is negative.
struct PolynomialFisheye {
  static constexpr std::size_t kCoefficients = 5;

  PolynomialFisheye(const std::array<double, kCoefficients>& coefficients, double theta_max);

  std::array<double, kCoefficients> a;  ///< For r in pixels
  /// The model is valid up to this theta; theta must grow strictly with r up to this theta.
  double theta_max_rad;
  double radius_max_px;  ///< The radius at theta_max_rad; NaN if theta does not reach it.

  std::optional<std::string_view> problem() const;
  std::optional<ElevationAt> elevation_at(double radius_px) const;
  /// The radius is exact to rounding; it is found by Newton's method, safeguarded by a bracket.
  std::optional<double> radius_px(double elevation_rad) const;

  double theta_at_rad(double radius_px) const;
  double theta_slope_rad_per_px(double radius_px) const;  ///< d theta / d r
};

}  // namespace azimuth
