#pragma once
// What OpenCV's features are found in when they are compared with ours.

#include <opencv2/core.hpp>

#include "slam/perception/sift/sift_perception.hpp"

namespace azimuth::test {

/// The working image that our front end makes of an image, in whole grey levels, and what of it is visible (255).
struct OpenCvSquare {
  cv::Mat image, mask;
};

OpenCvSquare opencv_square(SiftPerception& perception, const CameraRig& rig, const ImageView& image);

}  // namespace azimuth::test
