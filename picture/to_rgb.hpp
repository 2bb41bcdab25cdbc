#pragma once
#include <opencv2/core.hpp>

#include "slam/sample/image.hpp"

namespace azimuth {

/// The image in rgb8, as a person wants to see it; `rgb` is of its size already and may be a part of a larger picture.
/// Reentrant. False: the image is not readable(), and `rgb` is left alone.
bool to_rgb(const ImageView& image, cv::Mat& rgb);

}  // namespace azimuth
