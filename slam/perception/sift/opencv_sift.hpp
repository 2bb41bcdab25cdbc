#pragma once
#include <memory>

#include "slam/perception/sift/feature_finder.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// OpenCV's SIFT as it comes: the image doubled first, frames by the dominant gradients. Settings that it has as well
/// are passed on. Allocates for every image, and OpenCV may use threads of its own.
std::unique_ptr<FeatureFinder> opencv_sift(const SiftSettings& settings);

}  // namespace azimuth
