#pragma once
// Internal to slam/perception/picture.

#include <opencv2/core.hpp>

#include "slam/sample/image.hpp"

namespace azimuth {

/// The image in rgb8; `rgb` is of its size already and may be a part of a larger picture.
/// False: the image is not readable(), and `rgb` is left alone.
bool to_rgb(const ImageView& image, cv::Mat& rgb);

}  // namespace azimuth
