#include "daemon/record/frame_recorder.hpp"

#include "drivers/picture/to_rgb.hpp"
#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {
namespace {

/// The images stop while the disk still has room for one more file of samples above the floor.
LogSpace space_of_frames(const RecordSettings& settings) {
  return {.folder = settings.folder,
          .part = kFramesPart,
          .max_file_mb = settings.max_file_mb,
          .max_file_age_s = settings.max_file_age_s,
          .quota_mb = settings.frames_quota_mb,
          .min_free_mb = settings.min_free_mb > 0.0 ? settings.min_free_mb + settings.max_file_mb : 0.0,
          .flush_interval_s = settings.flush_interval_s};
}

bool is_encodable(PixelFormat pixels) {
  return pixels == PixelFormat::gray8 || pixels == PixelFormat::rgb8 || pixels == PixelFormat::bgr8;
}

ImageView view_of(const cv::Mat& rgb) {
  const FrameFormat format = packed_format(PixelFormat::rgb8, rgb.cols, rgb.rows);
  return {format, std::as_bytes(std::span(rgb.data, format.bytes()))};
}

}  // namespace

FrameRecorder::FrameRecorder(const RecordSettings& settings, EventTimes times)
    : channel_(settings.channel_prefix + std::string(channel::kCamera)),
      form_(settings.frames),
      rate_hz_(settings.frames_rate_hz),
      quality_(settings.frames_quality),
      times_(times),
      log_(space_of_frames(settings), {}, settings.channel_prefix) {}

void FrameRecorder::begin(const std::string& session) {
  if (begun_ || session.empty()) return;
  begun_ = true;
  log_.begin(session, times_.now());
}

void FrameRecorder::image(const KeptImage& image) {
  const ImageView seen{image.format, image.bytes};
  const bool as_it_is = form_ == RecordedFrames::raw || image.format.pixels == PixelFormat::mjpeg;
  fill_message(as_it_is ? seen : compressed(seen), image.stamp, message_);
  encode(message_, data_);
  log_.write(channel_, data_, times_.of_sample(image.stamp));
}

/// A view without bytes: the image cannot be encoded, and is recorded as one that could not be read.
ImageView FrameRecorder::compressed(const ImageView& image) {
  ImageView pixels = image;
  if (image.readable() && !is_encodable(image.format.pixels)) {
    rgb_.create(image.format.height_px, image.format.width_px, CV_8UC3);
    to_rgb(image, rgb_);
    pixels = view_of(rgb_);
  }
  const std::span<const std::byte> jpeg = encoder_.encode(pixels, quality_);
  return {packed_format(PixelFormat::mjpeg, image.format.width_px, image.format.height_px), jpeg};
}

}  // namespace azimuth
