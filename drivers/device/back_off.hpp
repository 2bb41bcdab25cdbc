#pragma once
#include <algorithm>
#include <chrono>
#include <optional>

#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// When a device that is away is to be tried next: after a twentieth of the time that it was tried already, so that it
/// is found again within a small part of the time that it was away.
///
/// Thread contract: thread-bound. Nothing allocates.
class BackOff {
 public:
  using Clock = DeviceClock;
  static constexpr int kShare = 20;
  static constexpr Clock::duration kEager = std::chrono::seconds(3);  ///< a node comes some time after its device

  /// Waits are no shorter than `first` and no longer than `longest`.
  constexpr BackOff(Clock::duration first, Clock::duration longest) : first_(first), longest_(longest) {}

  bool is_due(Clock::time_point now) const { return now >= next_; }
  Clock::time_point due() const { return next_; }

  /// It was tried, or was lost.
  void failed(Clock::time_point now) {
    if (!since_) since_ = now;
    const bool is_eager = now < eager_until_;
    next_ = now + (is_eager ? first_ : std::clamp<Clock::duration>((now - *since_) / kShare, first_, longest_));
  }
  /// It works: the next loss is a new one.
  void succeeded() { since_.reset(); }
  /// Something was plugged in: it is tried at once, and eagerly for a while.
  void wake(Clock::time_point now) {
    eager_until_ = now + kEager;
    since_ = next_ = now;
  }
  /// Not to be tried before then, whatever was said.
  void postpone(Clock::time_point until) { next_ = until; }

 private:
  Clock::duration first_, longest_;
  Clock::time_point next_{}, eager_until_{};
  std::optional<Clock::time_point> since_;  // tried in vain; none: it works
};

}  // namespace azimuth
