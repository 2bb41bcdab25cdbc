#include "daemon/pipeline/perception_stage.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace azimuth {

PerceptionStage::PerceptionStage(std::unique_ptr<Perception> perception, PixelFormat decoded)
    : perception_(std::move(perception)), decoded_(decoded) {
  assert(perception_);
}

void PerceptionStage::observe(const Frame& frame, BearingSet& out) {
  const Clock::time_point start = Clock::now();
  out.clear();
  look_at(frame, out);
  out.stamp = frame.stamp;
  out.sequence = frame.sequence;
  account(out.trouble, Clock::now() - start);
}

void PerceptionStage::look_at(const Frame& frame, BearingSet& out) {
  const ImageView image = uncompressed(frame);
  if (image.bytes.empty()) {
    out.trouble = ImageTrouble::unreadable;
    return;
  }
  perception_->observe(image, out);
}

/// No bytes: it cannot be decoded.
ImageView PerceptionStage::uncompressed(const Frame& frame) {
  if (frame.format().pixels != PixelFormat::mjpeg) return frame.view();
  // A decoder may read a byte twice, and whoever fills the frame's buffer may change it meanwhile.
  jpeg_.assign(frame.bytes().begin(), frame.bytes().end());
  return decoder_.decode(jpeg_, decoded_);
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
