#pragma once
#include <chrono>
#include <optional>

namespace azimuth {

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
