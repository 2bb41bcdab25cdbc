#pragma once
// Images in memory, as camera drivers provide and perception reads them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "slam/geometry/index.hpp"

namespace azimuth {

/// Memory layout of pixels, with 8 bits per sample. The names of Bayer formats give the first two pixels of the first
/// two rows. The numbers are exchanged between processes and must never change.
enum class PixelFormat : std::uint8_t {
  gray8 = 0,
  yuyv = 1,  ///< 4:2:2, two pixels in Y0 U Y1 V
  uyvy = 2,  ///< 4:2:2, two pixels in U Y0 V Y1
  rgb8 = 3,
  bgr8 = 4,
  bayer_rggb8 = 5,
  bayer_grbg8 = 6,
  bayer_gbrg8 = 7,
  bayer_bggr8 = 8,
  mjpeg = 9,  ///< each frame is one JPEG image
  nv12 = 10,  ///< 4:2:0, all rows of Y, then half as many rows of U V U V with the same stride
};
inline constexpr int kPixelFormats = 11;

/// The enumerator's name.
constexpr std::string_view name(PixelFormat pixels) {
  constexpr std::array<std::string_view, kPixelFormats> kNames{
      "gray8",       "yuyv",        "uyvy",        "rgb8",  "bgr8", "bayer_rggb8",
      "bayer_grbg8", "bayer_gbrg8", "bayer_bggr8", "mjpeg", "nv12"};
  return kNames.at(as_size(pixels));
}

/// Bytes of one pixel in its row; for nv12, of its luma. 0 for mjpeg, whose pixels have no fixed size.
constexpr int bytes_per_pixel(PixelFormat pixels) {
  switch (pixels) {
    case PixelFormat::mjpeg:
      return 0;
    case PixelFormat::yuyv:
    case PixelFormat::uyvy:
      return 2;
    case PixelFormat::rgb8:
    case PixelFormat::bgr8:
      return 3;
    default:
      return 1;
  }
}

struct FrameFormat {
  PixelFormat pixels = PixelFormat::gray8;
  int width_px = 0;
  int height_px = 0;
  int stride_bytes = 0;  ///< from row to row; 0 for mjpeg
  friend bool operator==(const FrameFormat&, const FrameFormat&) = default;

  /// Number of rows in memory, of all planes. For nv12, the rows of chroma follow those of the image.
  int rows() const { return pixels == PixelFormat::nv12 ? height_px + height_px / 2 : height_px; }
  /// Size of an uncompressed frame.
  std::size_t bytes() const { return as_size(stride_bytes) * as_size(rows()); }
};

/// Format with unpadded rows.
constexpr FrameFormat packed_format(PixelFormat pixels, int width_px, int height_px) {
  return {pixels, width_px, height_px, width_px * bytes_per_pixel(pixels)};
}

inline constexpr int kMaxFrameSide_px = 16384;
inline constexpr int kMaxRowPadding = 4096;

/// Whether the format is possible: sides from 1 to kMaxFrameSide_px, even width for the 4:2:2 formats, even sides for
/// 4:2:0, and rows that do not overlap and have at most kMaxRowPadding bytes of padding.
constexpr bool is_valid(const FrameFormat& format) {
  const auto is_side = [](int side_px) { return side_px >= 1 && side_px <= kMaxFrameSide_px; };
  if (!is_side(format.width_px) || !is_side(format.height_px)) return false;
  if (format.pixels == PixelFormat::mjpeg) return format.stride_bytes == 0;
  const bool in_squares = format.pixels == PixelFormat::nv12;
  const bool in_pairs = in_squares || format.pixels == PixelFormat::yuyv || format.pixels == PixelFormat::uyvy;
  if (in_pairs && format.width_px % 2 != 0) return false;
  if (in_squares && format.height_px % 2 != 0) return false;
  const int row_bytes = format.width_px * bytes_per_pixel(format.pixels);
  return format.stride_bytes >= row_bytes && format.stride_bytes <= row_bytes + kMaxRowPadding;
}

/// A view of an image in memory owned elsewhere: format.bytes() bytes, or one whole JPEG file for mjpeg. Empty `bytes`:
/// no image.
struct ImageView {
  FrameFormat format;
  std::span<const std::byte> bytes;

  /// Whether perception can read the image: uncompressed, valid format, complete.
  bool readable() const {
    return format.pixels != PixelFormat::mjpeg && is_valid(format) && bytes.size() >= format.bytes();
  }
  /// Start of row v. For nv12, the chroma of row v is in row height_px + v / 2.
  const std::uint8_t* row(int v) const {
    return reinterpret_cast<const std::uint8_t*>(bytes.data()) + as_size(v) * as_size(format.stride_bytes);
  }
};

}  // namespace azimuth
