#pragma once
// What decoding and encoding by libjpeg have in common. Internal to drivers/camera.
//
// It ends what it cannot do by a jump, so no function that it is called from has anything to destroy.

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <jpeglib.h>  // needs the two before it
#include <optional>

#include "slam/sample/image.hpp"

namespace azimuth::libjpeg {

/// Where libjpeg says what is wrong. Must lie first in what it is a part of: libjpeg hands it back by its own pointer.
struct Errors {
  jpeg_error_mgr base{};  // must be first
  std::jmp_buf refused{};
  std::array<char, JMSG_LENGTH_MAX> message{};

  /// Ends what is under way, by a jump to `refused`, with a message.
  [[noreturn]] static void stop(j_common_ptr common);
  static Errors& of(j_common_ptr common) { return *reinterpret_cast<Errors*>(common->err); }
  /// For jpeg_create_*(): nothing is printed, and every error ends by stop().
  jpeg_error_mgr* prepare();
};

/// The order of samples that libjpeg-turbo calls so; nothing for what is neither grey nor red, green and blue.
std::optional<J_COLOR_SPACE> order_of(PixelFormat pixels);

/// Sides that an image may have, for both ways.
bool is_small_enough(int width_px, int height_px);

}  // namespace azimuth::libjpeg
