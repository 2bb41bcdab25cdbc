#include "drivers/picture/to_rgb.hpp"

#include <opencv2/imgproc.hpp>

namespace azimuth {
namespace {

/// OpenCV's code for the conversion to RGB. OpenCV names Bayer patterns by the second and third pixel of the second
/// row.
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

/// Wraps the caller's bytes from row `first` on in a matrix, which nothing writes to.
cv::Mat matrix(const ImageView& image, int first, int rows, int columns, int channels) {
  auto* const bytes = const_cast<std::uint8_t*>(image.row(first));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  return {rows, columns, CV_8UC(channels), bytes, static_cast<std::size_t>(image.format.stride_bytes)};
}

cv::Mat matrix(const ImageView& image) {
  return matrix(image, 0, image.format.height_px, image.format.width_px, bytes_per_pixel(image.format.pixels));
}

/// The chroma plane of nv12.
cv::Mat chroma(const ImageView& image) {
  const int height_px = image.format.height_px;
  return matrix(image, height_px, height_px / 2, image.format.width_px / 2, 2);
}

}  // namespace

bool to_rgb(const ImageView& image, cv::Mat& rgb) {
  if (!image.readable()) return false;
  if (image.format.pixels == PixelFormat::rgb8)
    matrix(image).copyTo(rgb);
  else if (image.format.pixels == PixelFormat::nv12)
    cv::cvtColorTwoPlane(matrix(image), chroma(image), rgb, cv::COLOR_YUV2RGB_NV12);
  else
    cv::cvtColor(matrix(image), rgb, conversion(image.format.pixels));
  return true;
}

}  // namespace azimuth
