#pragma once
#include <optional>
#include <string_view>

#include "slam/camera/radial_profile.hpp"

namespace azimuth {

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

}  // namespace azimuth
