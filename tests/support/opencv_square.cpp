#include "tests/support/opencv_square.hpp"

#include "slam/camera/image_mask.hpp"
#include "slam/camera/make_camera.hpp"

namespace azimuth::test {

OpenCvSquare opencv_square(SiftPerception& perception, const CameraRig& rig, const ImageView& image) {
  BearingSet ignored;
  perception.observe(image, ignored);
  const Plane<std::uint16_t>& working = perception.working_image();
  const WorkingSquare& square = perception.working_square();
  const ImageMask mask(square.axes, mask_of(rig.image));
  OpenCvSquare result{cv::Mat(working.height(), working.width(), CV_8UC1),
                      cv::Mat(working.height(), working.width(), CV_8UC1)};
  for (int y = 0; y < working.height(); ++y) {
    for (int x = 0; x < working.width(); ++x) {
      result.image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((working.at(x, y) + 128) >> 8);
      result.mask.at<std::uint8_t>(y, x) = mask.visible(square.camera_pixel(x, y)) ? 255 : 0;
    }
  }
  return result;
}

}  // namespace azimuth::test
