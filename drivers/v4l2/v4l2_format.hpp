#pragma once
// Internal to drivers/v4l2: pixel formats as the kernel names them.

#include <cstdint>
#include <linux/videodev2.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth::v4l2 {

/// Ours for the kernel's code; nothing when no front end can read it.
std::optional<PixelFormat> pixel_format(std::uint32_t code);
/// "YUYV".
std::string code_text(std::uint32_t code);

/// "YUYV,MJPG" or "auto" (no codes); nothing when a code is not known.
std::optional<std::vector<std::uint32_t>> parse_formats(std::string_view text);
/// All codes, for a message.
std::string known_formats();
/// All that can be read, those first that cost least to read; with colour, those without it are left out.
std::vector<std::uint32_t> preferred_formats(bool wants_colour);

/// The part of v4l2_format that matters here, whichever of the two kinds of capture it is for.
struct ImageLayout {
  std::uint32_t code = 0;
  int width_px = 0, height_px = 0;
  std::uint32_t stride_bytes = 0;  ///< 0: not said
  std::uint32_t image_bytes = 0;
  std::uint32_t field = V4L2_FIELD_NONE;
  std::uint32_t planes = 1;
};
ImageLayout layout_of(const v4l2_format& format);
v4l2_format request_for(std::uint32_t buffer_type, std::uint32_t code, int width_px, int height_px);

/// Our own words for it; nothing when it is none of ours or its numbers contradict each other.
std::optional<FrameFormat> frame_format(const ImageLayout& layout);

}  // namespace azimuth::v4l2
