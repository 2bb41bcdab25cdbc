#include "drivers/camera/image_order.hpp"

#include <algorithm>

#include "drivers/device/device_clock.hpp"

namespace azimuth {

void ImageOrder::begin_stream() {
  device_sequence_.reset();
  corrupt_ = 0;
}

ImageOrder::Verdict ImageOrder::judge(std::uint64_t sequence, Stamp stamp, Clock::time_point now) {
  Verdict verdict;
  judge_sequence(sequence, verdict);
  judge_stamp(stamp, now, verdict);
  return verdict;
}

/// Dropped images are numbered as well, so that receivers see a gap in their place.
void ImageOrder::judge_sequence(std::uint64_t sequence, Verdict& verdict) {
  std::uint64_t step = any_ ? 2 : 0;  // 2 leaves a gap at the beginning of a new stream
  if (device_sequence_) {
    verdict.restarted = sequence <= *device_sequence_;
    step = verdict.restarted ? 1 : sequence - *device_sequence_;
    const std::uint64_t between = step - 1;
    verdict.missing = between - std::min(between, corrupt_);
  }
  device_sequence_ = sequence;
  corrupt_ = 0;
  any_ = true;
  sequence_ += step;
  verdict.sequence = sequence_;
}

void ImageOrder::judge_stamp(Stamp stamp, Clock::time_point now, Verdict& verdict) {
  const Stamp arrival = stamp_at(now);
  const bool early = stamp > arrival + kFuture;
  const bool late = stamp < arrival - kOldest || (newest_ && stamp <= *newest_);
  const bool give_up = late && dropped_in_a_row_ >= kMostDropped;
  verdict.replaced = early || give_up;
  verdict.stamp = verdict.replaced ? arrival : std::min(stamp, arrival);
  verdict.usable = (verdict.replaced || !late) && (!newest_ || verdict.stamp > *newest_);
  if (verdict.usable) newest_ = verdict.stamp;
  if (verdict.usable && !give_up) dropped_in_a_row_ = 0;
  if (!verdict.usable) dropped_in_a_row_ = std::min(dropped_in_a_row_ + 1, kMostDropped);
}

}  // namespace azimuth
