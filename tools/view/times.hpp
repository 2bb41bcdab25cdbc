#pragma once
// Times of the messages to and from a view: when they came, how often they are sent, and since when none has come.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace azimuth {

/// Time of reception of a message.
struct Reception {
  std::chrono::steady_clock::time_point at{};
  std::int64_t wall_us = 0;  ///< since the Unix epoch
};

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

/// Determines since when no message has arrived, and when to report that.
///
/// Thread contract: thread-bound.
class SilenceWatch {
 public:
  using Clock = std::chrono::steady_clock;

  explicit SilenceWatch(Clock::time_point now) : heard_(now) {}

  void hear(Clock::time_point now) {
    heard_ = now;
    told_.reset();
  }
  /// Time of the next report if no message arrives until then.
  Clock::time_point due() const { return told_ ? *told_ + kTellEvery : heard_ + kSilentAfter; }
  /// Notes a report. Returns the duration of the silence in seconds.
  double told(Clock::time_point now) {
    told_ = now;
    return std::chrono::duration<double>(now - heard_).count();
  }

 private:
  /// A running daemon sends a status every second.
  static constexpr std::chrono::milliseconds kSilentAfter{1400}, kTellEvery{1000};

  Clock::time_point heard_;
  std::optional<Clock::time_point> told_;
};

}  // namespace azimuth
