#include "daemon/publish/painter.hpp"

#include <azimuth/image_t.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <spdlog/spdlog.h>
#include <system_error>
#include <utility>

#include "base/files.hpp"
#include "base/unique_fd.hpp"
#include "drivers/wire/channels.hpp"

namespace azimuth {
namespace {

std::string because(int error) { return std::generic_category().message(error); }

/// Writes to a temporary file and renames it when it is complete, so that a reader never sees a part of a picture.
/// Returns why it failed; none: success.
std::optional<std::string> write_whole(const std::string& file, std::span<const std::byte> bytes) {
  const std::string part = file + ".part";
  const UniqueFd fd(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!fd) return because(errno);
  if (const int error = write_all(fd.get(), bytes)) return because(error);
  return std::rename(part.c_str(), file.c_str()) == 0 ? std::nullopt : std::optional(because(errno));
}

}  // namespace

Painter::Painter(const PictureSettings& settings, const PublishSettings& publish, const CameraRig& rig)
    : settings_(settings), picture_(rig), sender_(publish.lcm_url, publish.channel_prefix) {}

std::chrono::nanoseconds Painter::interval() const {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / settings_.rate_hz));
}

void Painter::paint(const SeenImage& image, const ExpectedImage& expected) {
  const ImageView drawn = picture_.draw(decoder_.uncompressed({image.format, image.bytes}, PixelFormat::rgb8),
                                        image.seen, expected.bearings, expected.in_map);
  const std::span<const std::byte> jpeg = encoder_.encode(drawn, settings_.quality);
  if (!settings_.file.empty()) write(jpeg);
  if (settings_.publish) publish(image.seen.stamp, drawn.format, jpeg);
  ++painted_;
}

void Painter::write(std::span<const std::byte> jpeg) {
  const std::string trouble = write_whole(settings_.file, jpeg).value_or("");
  if (trouble == trouble_) return;
  if (trouble.empty())
    spdlog::info("{}: pictures are written again", settings_.file);
  else
    spdlog::warn("{}: pictures cannot be written: {}", settings_.file, trouble);
  trouble_ = trouble;
}

void Painter::publish(Stamp stamp, const FrameFormat& format, std::span<const std::byte> jpeg) {
  image_t message{};
  message.utime = to_us(stamp);
  message.width = format.width_px;
  message.height = format.height_px;
  message.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  message.size = static_cast<std::int32_t>(jpeg.size());
  message.data.resize(jpeg.size());
  std::memcpy(message.data.data(), jpeg.data(), jpeg.size());
  sender_.send(channel::kPicture, message);
}

}  // namespace azimuth
