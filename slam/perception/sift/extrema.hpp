#pragma once
#include <cstdint>
#include <vector>

#include "slam/perception/image/visible_region.hpp"
#include "slam/perception/sift/feature_finder.hpp"
#include "slam/perception/sift/scale_space.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// Finds key points: extrema of the difference of Gaussians over position and scale, located between pixels by a
/// quadratic fit. Weak extrema, extrema on edges and extrema near hidden pixels are rejected.
///
/// The work is bounded for images of any noise: only the kMost strongest key points are kept.
///
/// Thread contract: thread-bound. Nothing allocates after construction unless images become larger.
class ExtremumFinder {
 public:
  static constexpr std::size_t kMost = 4096;

  explicit ExtremumFinder(const SiftSettings& settings);

  /// Replaces the content of `out` with the key points of `space`, in a reproducible but unspecified order. `region`
  /// belongs to the image from which `space` was built; `contrast` is the least contrast of a key point.
  void find(const ScaleSpace& space, const VisibleRegion& region, double contrast, std::vector<KeyPoint>& out);

 private:
  void find_in_row(const ScaleSpace& space, const VisibleRegion& region, int octave, int layer, int y,
                   std::vector<KeyPoint>& out);

  SiftSettings settings_;
  std::vector<std::int32_t> columns_;
  float least_sample_ = 0.0F, least_response_ = 0.0F;  // least_response_ rises when there is no room left
};

}  // namespace azimuth
