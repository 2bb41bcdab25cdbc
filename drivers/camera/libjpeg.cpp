#include "drivers/camera/libjpeg.hpp"

#include "drivers/camera/jpeg.hpp"

namespace azimuth::libjpeg {

void Errors::stop(j_common_ptr common) {
  Errors& errors = of(common);
  errors.base.format_message(common, errors.message.data());
  std::longjmp(errors.refused, 1);  // NOLINT(cert-err52-cpp): as libjpeg wants it
}

jpeg_error_mgr* Errors::prepare() {
  jpeg_std_error(&base);
  base.error_exit = stop;
  base.output_message = [](j_common_ptr) {};
  return &base;
}

std::optional<J_COLOR_SPACE> order_of(PixelFormat pixels) {
  switch (pixels) {
    case PixelFormat::gray8:
      return JCS_GRAYSCALE;
    case PixelFormat::rgb8:
      return JCS_EXT_RGB;
    case PixelFormat::bgr8:
      return JCS_EXT_BGR;
    default:
      return std::nullopt;
  }
}

bool is_small_enough(int width_px, int height_px) {
  return is_valid(packed_format(PixelFormat::gray8, width_px, height_px)) && width_px <= kMaxJpegPixels / height_px;
}

}  // namespace azimuth::libjpeg
