#include "drivers/v4l2/v4l2_format.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace azimuth::v4l2 {
namespace {

struct Known {
  std::uint32_t code;
  PixelFormat pixels;
};

/// The supported formats in the order of their cost for a front end that uses brightness: separate luma, luma
/// interleaved with chroma, sums of colours, colours to be interpolated, and finally compressed formats.
constexpr std::array kKnown{
    Known{V4L2_PIX_FMT_GREY, PixelFormat::gray8},         Known{V4L2_PIX_FMT_NV12, PixelFormat::nv12},
    Known{V4L2_PIX_FMT_YUYV, PixelFormat::yuyv},          Known{V4L2_PIX_FMT_UYVY, PixelFormat::uyvy},
    Known{V4L2_PIX_FMT_RGB24, PixelFormat::rgb8},         Known{V4L2_PIX_FMT_BGR24, PixelFormat::bgr8},
    Known{V4L2_PIX_FMT_SRGGB8, PixelFormat::bayer_rggb8}, Known{V4L2_PIX_FMT_SGRBG8, PixelFormat::bayer_grbg8},
    Known{V4L2_PIX_FMT_SGBRG8, PixelFormat::bayer_gbrg8}, Known{V4L2_PIX_FMT_SBGGR8, PixelFormat::bayer_bggr8},
    Known{V4L2_PIX_FMT_MJPEG, PixelFormat::mjpeg},        Known{V4L2_PIX_FMT_JPEG, PixelFormat::mjpeg}};

/// 4:2:2 has twice the colour resolution of 4:2:0, so a front end for colours prefers it.
constexpr std::array kColourFirst{V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_UYVY, V4L2_PIX_FMT_RGB24, V4L2_PIX_FMT_BGR24};

int as_int(std::uint32_t number) {
  return static_cast<int>(std::min<std::uint32_t>(number, std::numeric_limits<int>::max()));
}

}  // namespace

std::optional<PixelFormat> pixel_format(std::uint32_t code) {
  const auto* const known = std::ranges::find(kKnown, code, &Known::code);
  return known == kKnown.end() ? std::nullopt : std::optional(known->pixels);
}

std::string code_text(std::uint32_t code) {
  std::string text;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>(code >> shift & 0x7FU);
    text += letter > ' ' ? letter : '_';
  }
  return text;
}

std::string known_formats() {
  std::string text;
  for (const Known& known : kKnown) text += (text.empty() ? "" : ", ") + code_text(known.code);
  return text;
}

std::optional<std::vector<std::uint32_t>> parse_formats(std::string_view text) {
  std::vector<std::uint32_t> codes;
  if (text == "auto") return codes;
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    const auto* const known = std::ranges::find_if(kKnown, [&](const Known& k) { return code_text(k.code) == word; });
    if (known == kKnown.end()) return std::nullopt;
    codes.push_back(known->code);
    if (comma == std::string_view::npos) return codes;
    text.remove_prefix(comma + 1);
  }
}

std::vector<std::uint32_t> preferred_formats(bool wants_colour) {
  std::vector<std::uint32_t> codes;
  if (wants_colour) codes.assign(kColourFirst.begin(), kColourFirst.end());
  for (const Known& known : kKnown) {
    if (wants_colour && known.pixels == PixelFormat::gray8) continue;
    if (std::ranges::find(codes, known.code) == codes.end()) codes.push_back(known.code);
  }
  return codes;
}

ImageLayout layout_of(const v4l2_format& format) {
  if (format.type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
    const v4l2_pix_format_mplane& pix = format.fmt.pix_mp;
    return {pix.pixelformat,
            as_int(pix.width),
            as_int(pix.height),
            pix.plane_fmt[0].bytesperline,
            pix.plane_fmt[0].sizeimage,
            pix.field,
            pix.num_planes};
  }
  const v4l2_pix_format& pix = format.fmt.pix;
  return {pix.pixelformat, as_int(pix.width), as_int(pix.height), pix.bytesperline, pix.sizeimage, pix.field, 1};
}

v4l2_format request_for(std::uint32_t buffer_type, std::uint32_t code, int width_px, int height_px) {
  v4l2_format format{};
  format.type = buffer_type;
  const auto width = static_cast<std::uint32_t>(width_px), height = static_cast<std::uint32_t>(height_px);
  if (buffer_type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
    format.fmt.pix_mp.pixelformat = code;
    format.fmt.pix_mp.width = width;
    format.fmt.pix_mp.height = height;
    format.fmt.pix_mp.field = V4L2_FIELD_NONE;
    format.fmt.pix_mp.num_planes = 1;
  } else {
    format.fmt.pix.pixelformat = code;
    format.fmt.pix.width = width;
    format.fmt.pix.height = height;
    format.fmt.pix.field = V4L2_FIELD_NONE;
  }
  return format;
}

std::optional<FrameFormat> frame_format(const ImageLayout& layout) {
  const auto pixels = pixel_format(layout.code);
  if (!pixels || layout.planes != 1) return std::nullopt;
  if (layout.width_px > kMaxFrameSide_px || layout.height_px > kMaxFrameSide_px) return std::nullopt;
  FrameFormat format = packed_format(*pixels, layout.width_px, layout.height_px);
  if (*pixels == PixelFormat::mjpeg) return is_valid(format) ? std::optional(format) : std::nullopt;
  if (layout.stride_bytes != 0) format.stride_bytes = as_int(layout.stride_bytes);
  if (!is_valid(format) || layout.image_bytes < format.bytes()) return std::nullopt;
  return format;
}

}  // namespace azimuth::v4l2
