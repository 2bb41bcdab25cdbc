#include "tools/view/looker.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {

bool Looker::has_something() const {
  return text_ || phase_ != Phase::live || generation_ != view_.generation() || !outbox_.empty();
}

std::size_t Looker::read(std::span<char> into) {
  std::size_t written = 0;
  while (written < into.size()) {
    if (!text_) {
      const std::optional<ViewEvent> event = next();
      if (!event) break;
      text_ = event->text;
      sent_ = 0;
    }
    const std::size_t count = std::min(text_->size() - sent_, into.size() - written);
    std::copy_n(text_->data() + sent_, count, into.data() + written);
    sent_ += count;
    written += count;
    if (sent_ == text_->size()) text_.reset();
  }
  return written;
}

/// Starts the stream again and discards waiting events.
void Looker::begin() {
  generation_ = view_.generation();
  restarts_ = view_.restarts();
  phase_ = Phase::hello;
  told_until_t_s_ = -std::numeric_limits<double>::infinity();
  outbox_.clear();
}

std::optional<ViewEvent> Looker::next() {
  if (generation_ != view_.generation()) {
    const bool restarted = generation_ && restarts_ != view_.restarts();
    begin();
    if (restarted) return view_.restarted();
  }
  if (phase_ == Phase::hello) {
    phase_ = Phase::trail;
    return view_.hello();
  }
  if (phase_ == Phase::trail) {
    if (std::optional<ViewEvent> piece = view_.trail_after(told_until_t_s_)) return piece;
    phase_ = Phase::truth;
    told_until_t_s_ = -std::numeric_limits<double>::infinity();
  }
  if (phase_ == Phase::truth) {
    if (std::optional<ViewEvent> piece = view_.truth_trail_after(told_until_t_s_)) return piece;
    phase_ = Phase::live;
    outbox_.clear();  // view_.newest() contains their content
    for (const ViewEvent& event : view_.newest()) outbox_.push(event);
  }
  return outbox_.pop();
}

}  // namespace azimuth
