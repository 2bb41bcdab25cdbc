#include "daemon/pipeline/perception_stage.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {

PerceptionStage::PerceptionStage(std::unique_ptr<Perception> perception, PixelFormat decoded)
    : images_(std::move(perception)), decoded_(decoded) {}

void PerceptionStage::observe(const Frame& frame, BearingSet& out) {
  const Clock::time_point start = Clock::now();
  images_.observe(uncompressed(frame), frame.stamp, frame.sequence, out);
  account(out.trouble, Clock::now() - start);
}

/// Returns a view without bytes when the frame cannot be decoded.
ImageView PerceptionStage::uncompressed(const Frame& frame) {
  ImageView image = frame.view();
  if (image.format.pixels == PixelFormat::mjpeg) {
    // The buffer is copied because the decoder may read a byte twice, and the camera may change the buffer meanwhile.
    jpeg_.assign(image.bytes.begin(), image.bytes.end());
    image.bytes = jpeg_;
  }
  return decoder_.uncompressed(image, decoded_);
}

void PerceptionStage::account(ImageTrouble trouble, Clock::duration detect) {
  const double detect_us = std::chrono::duration<double, std::micro>(detect).count();
  ++status_.frames;
  status_.frames_unusable += trouble != ImageTrouble::none ? 1 : 0;
  status_.trouble = trouble;
  if (detected_++ == 0) detect_sum_us_ = status_.detect_max_us = 0.0;
  detect_sum_us_ += detect_us;
  status_.detect_max_us = std::max(status_.detect_max_us, detect_us);
  status_.detect_mean_us = detect_sum_us_ / static_cast<double>(detected_);
}

bool PerceptionStage::is_news(Clock::time_point now) {
  if (!pace_.due(status_.trouble, now)) return false;
  detected_ = 0;
  return true;
}

}  // namespace azimuth
