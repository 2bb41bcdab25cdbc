#include "daemon/pipeline/sample_turns.hpp"

#include "daemon/pipeline/paces.hpp"
#include "daemon/pipeline/storage.hpp"

namespace azimuth {

void SourceTurn::operator()() {
  const bool goes_on = source_.turn(bell_, wires_.samples);
  if (wires_.memories) hand_over_memory();
  if (!goes_on) wires_.over.set();
}

void SourceTurn::hand_over_memory() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_memory_ || !source_.remember(memory_)) return;
  next_memory_ = now + kHandOverInterval;
  wires_.memories->publish(memory_);
}

PerceptionTurn::PerceptionTurn(PerceptionStage& stage, Wires wires, Doorbell& bell,
                               std::chrono::nanoseconds picture_interval, double kept_rate_hz)
    : stage_(stage), wires_(wires), bell_(bell), picture_interval_(picture_interval), pace_(kept_rate_hz) {
  prepare(set_);
}

void PerceptionTurn::operator()() {
  bell_.wait(kNap);
  const bool over = wires_.sources_over.is_set();
  // Without room the frame stays in its wire, where a newer one replaces it. So the oldest frames are lost, as when
  // perception is slow.
  if (!wires_.bearings.has_room()) return;
  if (wires_.frames.take(frame_)) {
    stage_.observe(frame_, set_);
    if (wires_.seen_images) show(frame_);
    wires_.bearings.push(set_);
    if (wires_.kept_images) keep(frame_);
    frame_ = Frame{};  // only now, because a played source waits for the frame to come back
  }
  if (stage_.is_news(PerceptionStage::Clock::now()) || over) {
    news_ = stage_.status();
    wires_.status.publish(news_);
  }
  if (over) wires_.samples_over.set();
}

/// Runs before the bearings go to the estimator, so that the estimator knows that it has to publish the expected
/// bearings of this image.
void PerceptionTurn::show(const Frame& frame) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_picture_) return;
  next_picture_ = now + picture_interval_;
  image_.format = frame.format();
  image_.bytes.assign(frame.bytes().begin(), frame.bytes().end());
  image_.seen = set_;
  wires_.shown.store(set_.stamp, std::memory_order_relaxed);  // the push into the bearings' wire orders this store
  wires_.seen_images->publish(image_);
}

/// Runs after the bearings have been sent, because they have priority.
void PerceptionTurn::keep(const Frame& frame) {
  if (!pace_.takes(frame.stamp)) return;
  if (!wires_.kept_images->has_room()) return wires_.kept_images->refuse();
  kept_.stamp = frame.stamp;
  kept_.format = frame.format();
  kept_.bytes.assign(frame.bytes().begin(), frame.bytes().end());
  wires_.kept_images->push(kept_);
}

}  // namespace azimuth
