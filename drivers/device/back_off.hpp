#pragma once
#include <algorithm>
#include <chrono>
#include <optional>

#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// Schedules the attempts to reach a device that is away. The pause is a twentieth of the time since the first failed
/// attempt, so that the device is found again within a small part of the time that it was away.
///
/// Thread contract: thread-bound. Nothing allocates.
class BackOff {
 public:
  using Clock = DeviceClock;
  static constexpr int kShare = 20;
  /// Time after wake() with short pauses, because a device node appears some time after its device.
  static constexpr Clock::duration kEager = std::chrono::seconds(3);

  /// Pauses are at least `first` and at most `longest`.
  constexpr BackOff(Clock::duration first, Clock::duration longest) : first_(first), longest_(longest) {}

  bool is_due(Clock::time_point now) const { return now >= next_; }
  Clock::time_point due() const { return next_; }

  /// To be called when an attempt has failed, or the device was lost.
  void failed(Clock::time_point now) {
    if (!since_) since_ = now;
    const bool is_eager = now < eager_until_;
    next_ = now + (is_eager ? first_ : std::clamp<Clock::duration>((now - *since_) / kShare, first_, longest_));
  }
  /// To be called when the device works. The next loss starts a new series of pauses.
  void succeeded() { since_.reset(); }
  /// To be called when a device was plugged in: the next attempt is due at once, and pauses are short for a while.
  void wake(Clock::time_point now) {
    eager_until_ = now + kEager;
    since_ = next_ = now;
  }
  /// Allows no attempt before `until`, regardless of earlier calls.
  void postpone(Clock::time_point until) { next_ = until; }

 private:
  Clock::duration first_, longest_;
  Clock::time_point next_{}, eager_until_{};
  std::optional<Clock::time_point> since_;  // time of the first failed attempt; none: the device works
};

}  // namespace azimuth
