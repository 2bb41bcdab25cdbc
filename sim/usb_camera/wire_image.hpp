#pragma once
// Images in the layouts that emulated cameras send, and the test image that proves what arrived.
//
// Thread contract: reentrant.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/usb_camera/octets.hpp"
#include "slam/sample/image.hpp"

namespace azimuth::sim {

enum class WireFormat : std::uint8_t { yuyv, uyvy, grey, nv12, mjpeg };

/// By the name of the enumerator.
std::optional<WireFormat> wire_format(std::string_view name);

struct WireShape {
  WireFormat format = WireFormat::yuyv;
  int width_px = 0;
  int height_px = 0;
  friend bool operator==(const WireShape&, const WireShape&) = default;

  int bits_per_pixel() const;  ///< 0 for mjpeg, which has no fixed size
  std::size_t bytes() const;
};

/// The test image number `number`: its first four bytes are the number, little-endian, and every other byte follows
/// from the number and its place. Not for mjpeg.
void fill_pattern(const WireShape& shape, std::uint32_t number, Octets& into);

/// The number of a whole and undamaged test image; nothing for any other bytes.
std::optional<std::uint32_t> check_pattern(const WireShape& shape, OctetSpan image);

/// Whether cameras here can make `shape` of an image: same size, gray8 or rgb8.
bool is_convertible(const ImageView& image, const WireShape& shape);

/// Fills `into` with an image that is_convertible(), colours as BT.601 has them, each pair of pixels (and for nv12 of
/// rows) sharing the colour of its first. Not for mjpeg.
void convert_image(const ImageView& image, const WireShape& shape, Octets& into);

/// A JPEG file that carries `number` in a comment behind its first marker, and how to find it again.
void tag_jpeg(OctetSpan jpeg, std::uint32_t number, Octets& into);
std::optional<std::uint32_t> jpeg_tag(OctetSpan jpeg);

}  // namespace azimuth::sim
