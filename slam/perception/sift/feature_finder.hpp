#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/image/plane.hpp"
#include "slam/perception/image/visible_region.hpp"
#include "slam/perception/sift/key_point.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

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
