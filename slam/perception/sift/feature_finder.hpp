#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/image/plane.hpp"
#include "slam/perception/image/visible_region.hpp"
#include "slam/perception/sift/key_point.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// A detector with its descriptor: our own or a reference.
///
/// Thread contract: thread-bound. Same image, same bits.
class FeatureFinder {
 public:
  virtual ~FeatureFinder() = default;

  /// All key points of a square image, values in 1/256 of a grey level, that are far enough from what `region` hides.
  virtual void detect(const Plane<std::uint16_t>& image, const VisibleRegion& region, std::vector<KeyPoint>& out) = 0;
  /// Of key points in the image that was last given to detect(). May leave some out, which are then erased.
  virtual void describe(std::vector<KeyPoint>& key_points, std::vector<Descriptor>& out) = 0;
};

}  // namespace azimuth
