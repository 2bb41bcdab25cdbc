#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "slam/camera/radial_profile.hpp"

namespace azimuth {

/// A fisheye that looks straight up, in the model of OCamCalib (Scaramuzza): a pixel at radius r from the centre sees
/// along (x, y, f(r)), f(r) = a0 + a1 r + a2 r^2 + a3 r^3 + a4 r^4, so that the angle from the optical axis is
/// theta = atan2(r, -f(r)) and elevation = pi/2 - theta. a0 is negative.
struct PolynomialFisheye {
  static constexpr std::size_t kCoefficients = 5;

  PolynomialFisheye(const std::array<double, kCoefficients>& coefficients, double theta_max);

  std::array<double, kCoefficients> a;  ///< of r in pixels
  double theta_max_rad;                 ///< the model holds up to here; theta must grow strictly until then
  double radius_max_px;                 ///< where it is reached; NaN: it is not

  std::optional<std::string_view> problem() const;
  std::optional<ElevationAt> elevation_at(double radius_px) const;
  /// Exact to rounding: Newton's method, kept inside a bracket.
  std::optional<double> radius_px(double elevation_rad) const;

  double theta_at_rad(double radius_px) const;
  double theta_slope_rad_per_px(double radius_px) const;  ///< d theta / d r
};

}  // namespace azimuth
