#pragma once
// Internal to drivers/v4l2: the kernel's names of pixel formats.

#include <cstdint>
#include <linux/videodev2.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth::v4l2 {

/// The PixelFormat for the kernel's code; none when it is not supported.
std::optional<PixelFormat> pixel_format(std::uint32_t code);
/// The code as text, e.g. "YUYV".
std::string code_text(std::uint32_t code);

/// Parses "YUYV,MJPG" or "auto" (no codes); none when a code is unknown.
std::optional<std::vector<std::uint32_t>> parse_formats(std::string_view text);
/// All known codes, for a message.
std::string known_formats();
/// All supported formats, those with the lowest cost of reading first. With `wants_colour`, grey formats are left out.
std::vector<std::uint32_t> preferred_formats(bool wants_colour);

/// The relevant members of v4l2_format, for either kind of capture.
struct ImageLayout {
  std::uint32_t code = 0;
  int width_px = 0, height_px = 0;
  std::uint32_t stride_bytes = 0;  ///< 0: not reported
  std::uint32_t image_bytes = 0;
  std::uint32_t field = V4L2_FIELD_NONE;
  std::uint32_t planes = 1;
};
ImageLayout layout_of(const v4l2_format& format);
v4l2_format request_for(std::uint32_t buffer_type, std::uint32_t code, int width_px, int height_px);

/// The corresponding FrameFormat; none when the format is not supported or its numbers are inconsistent.
std::optional<FrameFormat> frame_format(const ImageLayout& layout);

}  // namespace azimuth::v4l2
