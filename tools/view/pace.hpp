#pragma once
#include <algorithm>
#include <chrono>

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

}  // namespace azimuth
