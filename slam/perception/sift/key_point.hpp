#pragma once
namespace azimuth {

/// A place in the working image that stands out from its surroundings at its scale.
struct KeyPoint {
  float x_px = 0.0F;  ///< to the right; whole numbers are the centres of pixels of the working image
  float y_px = 0.0F;  ///< down
  float sigma_px = 0.0F;
  float response = 0.0F;   ///< absolute difference of Gaussians at the extremum, for intensities from 0 to 1
  float angle_rad = 0.0F;  ///< of the descriptor's frame where the detector chose one, from the x axis towards y
  int octave = 0;
  int layer = 0;  ///< of the octave's images, the one that describes it
};

/// Stronger ones first; equal ones by place, so that the order never depends on how they were found.
inline bool stronger(const KeyPoint& a, const KeyPoint& b) {
  if (a.response != b.response) return a.response > b.response;
  if (a.y_px != b.y_px) return a.y_px < b.y_px;
  if (a.x_px != b.x_px) return a.x_px < b.x_px;
  if (a.sigma_px != b.sigma_px) return a.sigma_px < b.sigma_px;
  return a.angle_rad < b.angle_rad;
}

}  // namespace azimuth
