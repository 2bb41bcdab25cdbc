#pragma once
// The common parts of decoding and encoding by libjpeg. Internal to drivers/camera.
//
// libjpeg reports errors by longjmp, so no function that calls it may have objects to destroy.

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <jpeglib.h>  // needs the two includes above it
#include <optional>

#include "slam/sample/image.hpp"

namespace azimuth::libjpeg {

/// The error handler of libjpeg. It must be the first member of its structure, because libjpeg passes back only the
/// pointer to `base`.
struct Errors {
  jpeg_error_mgr base{};  // must be first
  std::jmp_buf refused{};
  std::array<char, JMSG_LENGTH_MAX> message{};

  /// Ends the current operation with a message, by a jump to `refused`.
  [[noreturn]] static void stop(j_common_ptr common);
  static Errors& of(j_common_ptr common) { return *reinterpret_cast<Errors*>(common->err); }
  /// For jpeg_create_*(). Nothing is printed, and every error calls stop().
  jpeg_error_mgr* prepare();
};

/// libjpeg-turbo's name for the pixel format; none for formats other than grey and red, green, blue.
std::optional<J_COLOR_SPACE> order_of(PixelFormat pixels);

/// True: decoding and encoding accept an image of this size.
bool is_small_enough(int width_px, int height_px);

}  // namespace azimuth::libjpeg
