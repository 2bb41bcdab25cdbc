#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "slam/camera/radial_profile.hpp"

namespace azimuth {

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
