#include "tests/equipment/usb_camera/image_feed.hpp"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <system_error>

#include "tests/equipment/usb_camera/log_line.hpp"

namespace azimuth::sim {
namespace {

constexpr int kJpegQuality = 90;
/// Time for rendering and conversion in an emulated machine, with a margin.
constexpr std::chrono::milliseconds kStale{150};

OctetSpan octets(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

}  // namespace

bool PatternFeed::fill(const WireShape& shape, std::uint32_t number, Octets& into) {
  if (shape.format != WireFormat::mjpeg) {
    fill_pattern(shape, number, into);
    return true;
  }
  fill_pattern({WireFormat::grey, shape.width_px, shape.height_px}, number, grey_);
  const ImageView image{packed_format(PixelFormat::gray8, shape.width_px, shape.height_px),
                        std::as_bytes(std::span(grey_))};
  tag_jpeg(octets(encoder_.encode(image, kJpegQuality)), number, into);
  return true;
}

FileFeed::FileFeed(const std::filesystem::path& file) : file_(file, std::ios::binary) {
  if (!file_) throw std::system_error(errno, std::generic_category(), file.string());
}

bool FileFeed::fill(const WireShape& shape, std::uint32_t, Octets& into) {
  into.resize(shape.bytes());
  const auto read = [&] {
    file_.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
    return !into.empty() && file_.good();
  };
  if (read()) return true;
  file_.clear();
  file_.seekg(0);
  return read();
}

bool LinkFeed::turn(Clock::time_point now) {
  camera_.turn(now);
  if (camera_.state().connected != connected_) {
    connected_ = camera_.state().connected;
    log_line(connected_ ? "camera link: connected" : "camera link: " + camera_.state().error);
  }
  Frame frame;
  bool arrived = false;
  while (camera_.take(frame)) {
    const auto age = now.time_since_epoch() - frame.stamp.time_since_epoch();
    oldest_ = std::max(oldest_, age);
    stale_ += age > kStale ? 1 : 0;
    if (age > kStale) continue;
    newest_ = std::move(frame);
    arrived = true;
  }
  return arrived;
}

std::string LinkFeed::status() const {
  return fmt::format(" oldest_ms={} stale={}", std::chrono::duration_cast<std::chrono::milliseconds>(oldest_).count(),
                     stale_);
}

bool LinkFeed::fill(const WireShape& shape, std::uint32_t number, Octets& into) {
  const ImageView image = newest_.view();
  if (!newest_ || !is_convertible(image, shape)) {
    if (newest_ && !complained_) {
      log_line(fmt::format("camera link: images are {} {}x{}, wanted {}x{}", name(image.format.pixels),
                           image.format.width_px, image.format.height_px, shape.width_px, shape.height_px));
    }
    complained_ = complained_ || newest_;
    return false;
  }
  if (shape.format == WireFormat::mjpeg) {
    tag_jpeg(octets(encoder_.encode(image, kJpegQuality)), number, into);
  } else {
    convert_image(image, shape, into);
  }
  return true;
}

}  // namespace azimuth::sim
