#pragma once
#include <cmath>
#include <optional>
#include <string_view>

#include "slam/camera/radial_profile.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

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

}  // namespace azimuth
