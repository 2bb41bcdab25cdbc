#include "tests/equipment/usb_camera/wire_image.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace azimuth::sim {
namespace {

constexpr std::array<std::string_view, 5> kNames{"yuyv", "uyvy", "grey", "nv12", "mjpeg"};
constexpr std::size_t kNumberBytes = 4;
constexpr std::array<std::uint8_t, 2> kJpegStart{0xff, 0xd8};
constexpr std::array<std::uint8_t, 4> kCommentOfSix{0xff, 0xfe, 0x00, 0x06};

/// Bytes differ from row to row and from image to image, so that a shifted row or a mixture of two images is detected.
std::uint8_t pattern_byte(std::uint32_t number, std::size_t place) {
  return static_cast<std::uint8_t>(place * 7 + (place >> 8U) * 13 + number * std::size_t{31});
}

struct Yuv {
  std::uint8_t y, u, v;
};

/// BT.601 in its limited range, in fixed point with 8 bits.
Yuv yuv_of(const ImageView& image, int column, int row) {
  const std::uint8_t* pixel = image.row(row) + column * bytes_per_pixel(image.format.pixels);
  const bool grey = image.format.pixels == PixelFormat::gray8;
  const int r = pixel[0], g = pixel[grey ? 0 : 1], b = pixel[grey ? 0 : 2];
  const auto octet = [](int scaled, int offset) { return static_cast<std::uint8_t>((scaled + 128) / 256 + offset); };
  // The offset of 128 keeps the sum positive for the division.
  return {octet(66 * r + 129 * g + 25 * b, 16), octet(-38 * r - 74 * g + 112 * b + 128 * 256, 0),
          octet(112 * r - 94 * g - 18 * b + 128 * 256, 0)};
}

/// Full range, as sent by cameras without colour.
std::uint8_t grey_of(const ImageView& image, int column, int row) {
  const std::uint8_t* pixel = image.row(row) + column * bytes_per_pixel(image.format.pixels);
  if (image.format.pixels == PixelFormat::gray8) return *pixel;
  return static_cast<std::uint8_t>((77 * pixel[0] + 150 * pixel[1] + 29 * pixel[2] + 128) / 256);
}

void put_pairs(const ImageView& image, const WireShape& shape, Octets& into) {
  for (int row = 0; row < shape.height_px; ++row) {
    for (int column = 0; column < shape.width_px; column += 2) {
      const Yuv first = yuv_of(image, column, row);
      const std::uint8_t second = yuv_of(image, column + 1, row).y;
      if (shape.format == WireFormat::yuyv) {
        put_octets(into, std::array{first.y, first.u, second, first.v});
      } else {
        put_octets(into, std::array{first.u, first.y, first.v, second});
      }
    }
  }
}

void put_planes(const ImageView& image, const WireShape& shape, Octets& into) {
  for (int row = 0; row < shape.height_px; ++row) {
    for (int column = 0; column < shape.width_px; ++column) into.push_back(yuv_of(image, column, row).y);
  }
  for (int row = 0; row < shape.height_px; row += 2) {
    for (int column = 0; column < shape.width_px; column += 2) {
      const Yuv colour = yuv_of(image, column, row);
      put_octets(into, std::array{colour.u, colour.v});
    }
  }
}

}  // namespace

std::optional<WireFormat> wire_format(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<WireFormat>(found - kNames.begin());
}

int WireShape::bits_per_pixel() const {
  switch (format) {
    case WireFormat::yuyv:
    case WireFormat::uyvy:
      return 16;
    case WireFormat::nv12:
      return 12;
    case WireFormat::grey:
      return 8;
    default:
      return 0;
  }
}

std::size_t WireShape::bytes() const {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
         static_cast<std::size_t>(bits_per_pixel()) / 8;
}

void fill_pattern(const WireShape& shape, std::uint32_t number, Octets& into) {
  assert(shape.format != WireFormat::mjpeg && shape.bytes() >= kNumberBytes);
  into.clear();
  put_le(into, number);
  into.resize(shape.bytes());
  for (std::size_t place = kNumberBytes; place < into.size(); ++place) into[place] = pattern_byte(number, place);
}

std::optional<std::uint32_t> check_pattern(const WireShape& shape, OctetSpan image) {
  if (image.size() != shape.bytes() || image.size() < kNumberBytes) return std::nullopt;
  const auto number = static_cast<std::uint32_t>(get_le(image, kNumberBytes));
  for (std::size_t place = kNumberBytes; place < image.size(); ++place) {
    if (image[place] != pattern_byte(number, place)) return std::nullopt;
  }
  return number;
}

bool is_convertible(const ImageView& image, const WireShape& shape) {
  const bool pixels = image.format.pixels == PixelFormat::gray8 || image.format.pixels == PixelFormat::rgb8;
  return pixels && image.readable() && image.format.width_px == shape.width_px &&
         image.format.height_px == shape.height_px && shape.width_px % 2 == 0;
}

void convert_image(const ImageView& image, const WireShape& shape, Octets& into) {
  assert(is_convertible(image, shape) && shape.format != WireFormat::mjpeg);
  into.clear();
  into.reserve(shape.bytes());
  if (shape.format == WireFormat::nv12) return put_planes(image, shape, into);
  if (shape.format != WireFormat::grey) return put_pairs(image, shape, into);
  for (int row = 0; row < shape.height_px; ++row) {
    for (int column = 0; column < shape.width_px; ++column) into.push_back(grey_of(image, column, row));
  }
}

void tag_jpeg(OctetSpan jpeg, std::uint32_t number, Octets& into) {
  assert(jpeg.size() > kJpegStart.size());
  into.assign(kJpegStart.begin(), kJpegStart.end());
  put_octets(into, kCommentOfSix);
  put_le(into, number);
  put_octets(into, from_offset(jpeg, kJpegStart.size()));
}

std::optional<std::uint32_t> jpeg_tag(OctetSpan jpeg) {
  const OctetSpan comment = from_offset(jpeg, kJpegStart.size());
  if (comment.size() < kCommentOfSix.size() + kNumberBytes) return std::nullopt;
  if (!std::ranges::equal(jpeg.first(kJpegStart.size()), kJpegStart)) return std::nullopt;
  if (!std::ranges::equal(comment.first(kCommentOfSix.size()), kCommentOfSix)) return std::nullopt;
  return static_cast<std::uint32_t>(get_le(from_offset(comment, kCommentOfSix.size()), kNumberBytes));
}

}  // namespace azimuth::sim
