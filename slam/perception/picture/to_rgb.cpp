#include "slam/perception/picture/to_rgb.hpp"

#include <opencv2/imgproc.hpp>

namespace azimuth {
namespace {

/// OpenCV's code for the conversion to RGB. It names Bayer patterns by the second row's second and third pixel.
int conversion(PixelFormat pixels) {
  switch (pixels) {
    case PixelFormat::yuyv:
      return cv::COLOR_YUV2RGB_YUYV;
    case PixelFormat::uyvy:
      return cv::COLOR_YUV2RGB_UYVY;
    case PixelFormat::bgr8:
      return cv::COLOR_BGR2RGB;
    case PixelFormat::bayer_rggb8:
      return cv::COLOR_BayerBG2RGB;
    case PixelFormat::bayer_grbg8:
      return cv::COLOR_BayerGB2RGB;
    case PixelFormat::bayer_gbrg8:
      return cv::COLOR_BayerGR2RGB;
    case PixelFormat::bayer_bggr8:
      return cv::COLOR_BayerRG2RGB;
    default:
      return cv::COLOR_GRAY2RGB;
  }
}

/// The caller's bytes as OpenCV sees them; nothing writes to them.
cv::Mat matrix(const ImageView& image) {
  const int type = CV_8UC(bytes_per_pixel(image.format.pixels));
  auto* const bytes = const_cast<std::byte*>(image.bytes.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  return {image.format.height_px, image.format.width_px, type, bytes,
          static_cast<std::size_t>(image.format.stride_bytes)};
}

}  // namespace

bool to_rgb(const ImageView& image, cv::Mat& rgb) {
  if (!image.readable()) return false;
  if (image.format.pixels == PixelFormat::rgb8)
    matrix(image).copyTo(rgb);
  else
    cv::cvtColor(matrix(image), rgb, conversion(image.format.pixels));
  return true;
}

}  // namespace azimuth
