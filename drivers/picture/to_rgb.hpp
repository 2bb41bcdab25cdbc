#pragma once
#include <opencv2/core.hpp>

#include "slam/sample/image.hpp"

namespace azimuth {

/// Converts the image to rgb8 for display. `rgb` must have the image's size already and may be a part of a larger
/// picture. Returns false and leaves `rgb` unchanged if the image is not readable(). Reentrant.
bool to_rgb(const ImageView& image, cv::Mat& rgb);

}  // namespace azimuth
