#pragma once
// Image layouts of the emulated cameras, and the test image that allows a check of the received data.
//
// Thread contract: reentrant.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "slam/sample/image.hpp"
#include "tests/equipment/usb_camera/octets.hpp"

namespace azimuth::sim {

enum class WireFormat : std::uint8_t { yuyv, uyvy, grey, nv12, mjpeg };

/// Finds a format by the name of its enumerator.
std::optional<WireFormat> wire_format(std::string_view name);

struct WireShape {
  WireFormat format = WireFormat::yuyv;
  int width_px = 0;
  int height_px = 0;
  friend bool operator==(const WireShape&, const WireShape&) = default;

  int bits_per_pixel() const;  ///< 0 for mjpeg, which has no fixed size
  std::size_t bytes() const;
};

/// Makes the test image number `number`: the first four bytes are the number, little-endian, and every other byte is a
/// function of the number and of its position. Not for mjpeg.
void fill_pattern(const WireShape& shape, std::uint32_t number, Octets& into);

/// The number of a complete, undamaged test image; nullopt for any other bytes.
std::optional<std::uint32_t> check_pattern(const WireShape& shape, OctetSpan image);

/// Whether convert_image() can make `shape` of the image: same size, gray8 or rgb8.
bool is_convertible(const ImageView& image, const WireShape& shape);

/// Fills `into` with an image that is_convertible(), in BT.601 colours. Each pair of pixels (for nv12 also of rows) has
/// the colour of its first. Not for mjpeg.
void convert_image(const ImageView& image, const WireShape& shape, Octets& into);

/// tag_jpeg() writes a JPEG file with `number` in a comment after the first marker; jpeg_tag() reads the number.
void tag_jpeg(OctetSpan jpeg, std::uint32_t number, Octets& into);
std::optional<std::uint32_t> jpeg_tag(OctetSpan jpeg);

}  // namespace azimuth::sim
