#pragma once
namespace azimuth {

/// A point of the working image that differs from its surroundings at its scale.
struct KeyPoint {
  float x_px = 0.0F;  ///< To the right; integer values are pixel centres of the working image.
  float y_px = 0.0F;  ///< Down
  float sigma_px = 0.0F;
  float response = 0.0F;   ///< Absolute difference of Gaussians at the extremum, for intensities from 0 to 1
  float angle_rad = 0.0F;  ///< Angle of the descriptor's frame, if the detector chose one, from the x axis towards y
  int octave = 0;
  int layer = 0;  ///< Index of the octave's image from which the descriptor is computed
};

/// Orders key points by falling response, and equal ones by position, so that the order does not depend on the search.
inline bool stronger(const KeyPoint& a, const KeyPoint& b) {
  if (a.response != b.response) return a.response > b.response;
  if (a.y_px != b.y_px) return a.y_px < b.y_px;
  if (a.x_px != b.x_px) return a.x_px < b.x_px;
  if (a.sigma_px != b.sigma_px) return a.sigma_px < b.sigma_px;
  return a.angle_rad < b.angle_rad;
}

}  // namespace azimuth
