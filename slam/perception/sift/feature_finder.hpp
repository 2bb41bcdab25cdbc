#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/image/plane.hpp"
#include "slam/perception/image/visible_region.hpp"
#include "slam/sample/bearings.hpp"

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

/// A detector with its descriptor: the built-in one or a reference.
///
/// Thread contract: thread-bound. The same image gives the same bits.
class FeatureFinder {
 public:
  virtual ~FeatureFinder() = default;

  /// Finds all key points of a square image (values in 1/256 of a grey level) that are far enough from the pixels that
  /// `region` hides.
  virtual void detect(const Plane<std::uint16_t>& image, const VisibleRegion& region, std::vector<KeyPoint>& out) = 0;
  /// Describes key points of the image last given to detect(). May drop some key points, which are erased from
  /// `key_points`.
  virtual void describe(std::vector<KeyPoint>& key_points, std::vector<Descriptor>& out) = 0;
};

}  // namespace azimuth
