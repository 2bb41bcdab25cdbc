#include "drivers/wire/image_message.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/wire/plausible.hpp"

namespace azimuth {

namespace {

constexpr std::array<std::pair<std::int32_t, PixelFormat>, kPixelFormats> kFormats{
    {{image_t::PIXEL_FORMAT_GRAY, PixelFormat::gray8},
     {image_t::PIXEL_FORMAT_YUYV, PixelFormat::yuyv},
     {image_t::PIXEL_FORMAT_UYVY, PixelFormat::uyvy},
     {image_t::PIXEL_FORMAT_RGB, PixelFormat::rgb8},
     {image_t::PIXEL_FORMAT_BGR, PixelFormat::bgr8},
     {image_t::PIXEL_FORMAT_BAYER_RGGB, PixelFormat::bayer_rggb8},
     {image_t::PIXEL_FORMAT_BAYER_GRBG, PixelFormat::bayer_grbg8},
     {image_t::PIXEL_FORMAT_BAYER_GBRG, PixelFormat::bayer_gbrg8},
     {image_t::PIXEL_FORMAT_BAYER_BGGR, PixelFormat::bayer_bggr8},
     {image_t::PIXEL_FORMAT_MJPEG, PixelFormat::mjpeg},
     {image_t::PIXEL_FORMAT_NV12, PixelFormat::nv12}}};

/// Reads big-endian fields. Reads past the end return zero and are recorded.
class Walk {
 public:
  explicit Walk(Bytes data) : rest_(data) {}

  std::uint32_t uint32() {
    std::uint32_t word = 0;
    for (const std::byte byte : bytes(4)) word = (word << 8U) | std::to_integer<std::uint32_t>(byte);
    return word;
  }
  std::int32_t int32() { return static_cast<std::int32_t>(uint32()); }
  std::int64_t int64() {
    const std::uint64_t high = uint32();
    return static_cast<std::int64_t>(high << 32U | uint32());
  }
  Bytes bytes(std::size_t count) {
    if (count > rest_.size()) {
      too_short_ = true;
      return {};
    }
    const Bytes taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  bool good() const { return !too_short_; }
  bool ended_well() const { return !too_short_ && rest_.empty(); }

 private:
  Bytes rest_;
  bool too_short_ = false;
};

/// Skips the metadata. A negative count reads as a number for which no message is long enough.
void skip_metadata(Walk& walk) {
  for (std::uint32_t left = walk.uint32(); left > 0 && walk.good(); --left) {
    walk.bytes(walk.uint32());  // key
    walk.bytes(walk.uint32());  // value
  }
}

/// The size of a JPEG image is in its own header, so the size in the message is not used.
std::optional<ImageView> view_of(FrameFormat format, Bytes pixels) {
  if (format.pixels == PixelFormat::mjpeg) {
    format.stride_bytes = 0;
    return ImageView{format, pixels};
  }
  if (format.stride_bytes == 0) format = packed_format(format.pixels, format.width_px, format.height_px);
  const ImageView image{format, pixels};
  return image.readable() ? std::optional(image) : std::nullopt;
}

}  // namespace

bool claims_image(Bytes data) { return Walk(data).int64() == image_t::getHash(); }

std::optional<ImageMessage> decode_image(Bytes data) {
  Walk walk(data);
  if (walk.int64() != image_t::getHash()) return std::nullopt;
  const std::int64_t utime_us = walk.int64();
  FrameFormat format;
  format.width_px = walk.int32();
  format.height_px = walk.int32();
  format.stride_bytes = walk.int32();
  const std::int32_t number = walk.int32();
  const Bytes pixels = walk.bytes(walk.uint32());
  skip_metadata(walk);
  if (!walk.ended_well() || !is_plausible_stamp(utime_us)) return std::nullopt;

  ImageMessage message{.stamp = stamp_from_us(utime_us), .image = {}};
  const auto known = std::ranges::find(kFormats, number, [](const auto& pair) { return pair.first; });
  if (known == kFormats.end()) return message;
  format.pixels = known->second;
  const std::optional<ImageView> image = view_of(format, pixels);
  if (!image) return std::nullopt;
  message.image = *image;
  message.supported = true;
  return message;
}

void fill_message(const ImageView& image, Stamp stamp, image_t& message) {
  const bool is_there = !image.bytes.empty();
  const PixelFormat pixels = is_there ? image.format.pixels : PixelFormat::mjpeg;
  const auto known = std::ranges::find(kFormats, pixels, [](const auto& pair) { return pair.second; });
  message.utime = to_us(stamp);
  message.width = is_there ? image.format.width_px : 0;
  message.height = is_there ? image.format.height_px : 0;
  message.row_stride = is_there ? image.format.stride_bytes : 0;
  message.pixelformat = known->first;
  message.size = static_cast<std::int32_t>(image.bytes.size());
  const auto* first = reinterpret_cast<const std::uint8_t*>(image.bytes.data());
  message.data.assign(first, first + image.bytes.size());
  message.nmetadata = 0;
  message.metadata.clear();
}

}  // namespace azimuth
