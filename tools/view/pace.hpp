#pragma once
#include <algorithm>
#include <chrono>
#include <optional>

namespace azimuth {

/// Limits the rate of sending.
struct Pace {
  using Clock = std::chrono::steady_clock;

  Clock::duration interval;
  Clock::time_point next{};
  bool waits = false;

  /// Notes that something was sent. Jitter is tolerated: a message at the nominal rate may be early by one interval.
  void sent(Clock::time_point now) {
    next = std::max(next, now - interval) + interval;
    waits = false;
  }
};

/// The newest value and its rate limit.
template <class T>
struct Paced {
  Pace pace;
  std::optional<T> newest = {};
};

}  // namespace azimuth
