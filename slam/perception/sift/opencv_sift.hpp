#pragma once
#include <memory>

#include "slam/perception/sift/feature_finder.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// OpenCV's unmodified SIFT: it doubles the image first and takes frames from the dominant gradients. Settings that
/// exist in OpenCV are passed on. Allocates for every image, and OpenCV may use threads of its own.
std::unique_ptr<FeatureFinder> opencv_sift(const SiftSettings& settings);

}  // namespace azimuth
