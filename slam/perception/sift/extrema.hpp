#pragma once
#include <cstdint>
#include <vector>

#include "slam/perception/image/visible_region.hpp"
#include "slam/perception/sift/key_point.hpp"
#include "slam/perception/sift/scale_space.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// Finds key points: extrema of the difference of Gaussians over place and scale, placed between pixels by a quadratic
/// fit, neither weak nor on an edge nor near anything hidden.
///
/// However noisy an image is, the work is bounded: kMost key points are kept, the strongest, and weaker ones make room.
///
/// Thread contract: thread-bound. Nothing allocates after construction but for larger images.
class ExtremumFinder {
 public:
  static constexpr std::size_t kMost = 4096;

  explicit ExtremumFinder(const SiftSettings& settings);

  /// Replaces `out` by the key points of `space`, in no particular but always the same order. `region` is that of the
  /// image `space` was built from, `contrast` the least that a key point must have in it.
  void find(const ScaleSpace& space, const VisibleRegion& region, double contrast, std::vector<KeyPoint>& out);

 private:
  void find_in_row(const ScaleSpace& space, const VisibleRegion& region, int octave, int layer, int y,
                   std::vector<KeyPoint>& out);

  SiftSettings settings_;
  std::vector<std::int32_t> columns_;
  float least_sample_ = 0.0F, least_response_ = 0.0F;  // the latter rises when there is no room left
};

}  // namespace azimuth
