#pragma once
#include <algorithm>
#include <chrono>
#include <optional>

namespace azimuth {

/// How often something may be sent.
struct Pace {
  using Clock = std::chrono::steady_clock;

  Clock::duration interval;
  Clock::time_point next{};
  bool waits = false;

  /// What comes a little irregularly, at just this pace, is sent all the same: one may be early by an interval.
  void sent(Clock::time_point now) {
    next = std::max(next, now - interval) + interval;
    waits = false;
  }
};

/// The newest of what is sent at that pace.
template <class T>
struct Paced {
  Pace pace;
  std::optional<T> newest = {};
};

}  // namespace azimuth
