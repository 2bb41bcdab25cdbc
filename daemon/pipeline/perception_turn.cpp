#include "daemon/pipeline/perception_turn.hpp"

#include "daemon/pipeline/paces.hpp"
#include "daemon/pipeline/storage.hpp"

namespace azimuth {

PerceptionTurn::PerceptionTurn(PerceptionStage& stage, Wires wires, Doorbell& bell,
                               std::chrono::nanoseconds picture_interval, double kept_rate_hz)
    : stage_(stage), wires_(wires), bell_(bell), picture_interval_(picture_interval), pace_(kept_rate_hz) {
  prepare(set_);
}

void PerceptionTurn::operator()() {
  bell_.wait(kNap);
  const bool over = wires_.sources_over.is_set();
  // Without room the frame stays where a newer one replaces it: what is lost is the oldest, as when images are slow.
  if (!wires_.bearings.has_room()) return;
  if (wires_.frames.take(frame_)) {
    stage_.observe(frame_, set_);
    if (wires_.seen_images) show(frame_);
    wires_.bearings.push(set_);
    if (wires_.kept_images) keep(frame_);
    frame_ = Frame{};  // only now: a played source waits for it
  }
  if (stage_.is_news(PerceptionStage::Clock::now()) || over) {
    news_ = stage_.status();
    wires_.status.publish(news_);
  }
  if (over) wires_.samples_over.set();
}

/// Before the bearings go to the estimator, which is to say what it expected of this very image.
void PerceptionTurn::show(const Frame& frame) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_picture_) return;
  next_picture_ = now + picture_interval_;
  image_.format = frame.format();
  image_.bytes.assign(frame.bytes().begin(), frame.bytes().end());
  image_.seen = set_;
  wires_.shown.store(set_.stamp, std::memory_order_relaxed);  // the bearings' wire orders it
  wires_.seen_images->publish(image_);
}

/// After its bearings have gone on, which are in a hurry.
void PerceptionTurn::keep(const Frame& frame) {
  if (!pace_.takes(frame.stamp)) return;
  if (!wires_.kept_images->has_room()) return wires_.kept_images->refuse();
  kept_.stamp = frame.stamp;
  kept_.format = frame.format();
  kept_.bytes.assign(frame.bytes().begin(), frame.bytes().end());
  wires_.kept_images->push(kept_);
}

}  // namespace azimuth
