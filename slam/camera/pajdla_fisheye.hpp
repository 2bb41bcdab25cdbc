#pragma once
#include <optional>
#include <string_view>

#include "slam/camera/radial_profile.hpp"

namespace azimuth {

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

}  // namespace azimuth
