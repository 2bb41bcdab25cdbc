#pragma once
// Images on which OpenCV's features are compared with Azimuth's.

#include <opencv2/core.hpp>

#include "slam/perception/sift/sift_perception.hpp"

namespace azimuth::test {

/// The working image that Azimuth's front end makes of an image, in whole grey levels, and the mask of its visible
/// pixels (255).
struct OpenCvSquare {
  cv::Mat image, mask;
};

OpenCvSquare opencv_square(SiftPerception& perception, const CameraRig& rig, const ImageView& image);

}  // namespace azimuth::test
