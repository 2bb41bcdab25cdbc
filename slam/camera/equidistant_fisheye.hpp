#pragma once
#include <optional>
#include <string_view>

#include "slam/camera/radial_profile.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

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

}  // namespace azimuth
