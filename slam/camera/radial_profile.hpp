#pragma once
// The concept of a radial profile: the mapping from radius in the image to elevation, for a camera with vertical axis.
//
// Each profile P has
//   std::optional<std::string_view> P::problem() const           the reason why its parameters are invalid, or nullopt
//   std::optional<ElevationAt> P::elevation_at(radius_px) const  nullopt beyond the end of the image
//   std::optional<double> P::radius_px(elevation_rad) const      nullopt for directions that the camera cannot see
// The two mappings are inverse to each other, strictly monotone and smooth. All profiles are plain values. Thread
// contract: reentrant.

namespace azimuth {

struct ElevationAt {
  double elevation_rad = 0.0;     ///< Up from the horizontal
  double slope_rad_per_px = 0.0;  ///< d elevation / d radius
};

}  // namespace azimuth
