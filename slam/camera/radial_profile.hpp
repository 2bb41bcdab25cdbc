#pragma once
// What a radial profile is: the second half of a camera with vertical axis, from radius in the image to elevation.
//
// Each profile P has
//   std::optional<std::string_view> P::problem() const           why its parameters make no camera, if they do not
//   std::optional<ElevationAt> P::elevation_at(radius_px) const  nothing beyond the end of the image
//   std::optional<double> P::radius_px(elevation_rad) const      nothing for directions it cannot see
// which are inverse to each other, strictly monotone and smooth. All are plain values. Thread contract: reentrant.

namespace azimuth {

struct ElevationAt {
  double elevation_rad = 0.0;     ///< up from the horizontal
  double slope_rad_per_px = 0.0;  ///< d elevation / d radius
};

}  // namespace azimuth
