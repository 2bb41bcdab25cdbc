#pragma once
#include <chrono>
#include <optional>

namespace azimuth {

/// Since when nothing comes, and when that is to be said.
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
  /// When it is to be said, if nothing comes until then.
  Clock::time_point due() const { return told_ ? *told_ + kTellEvery : heard_ + kSilentAfter; }
  /// It is said now: for how many seconds it lasts.
  double told(Clock::time_point now) {
    told_ = now;
    return std::chrono::duration<double>(now - heard_).count();
  }

 private:
  /// A daemon that has nothing else to say sends a status each second.
  static constexpr std::chrono::milliseconds kSilentAfter{1400}, kTellEvery{1000};

  Clock::time_point heard_;
  std::optional<Clock::time_point> told_;
};

}  // namespace azimuth
