#pragma once
#include <chrono>
#include <cstdint>
#include <thread>

namespace azimuth::guest {

/// Paces a loop at a rate or as fast as possible, for a given time.
///
/// Thread contract: thread-bound.
class Pacing {
 public:
  /// A `rate_hz` of 0 means no pause between turns, `seconds` of 0 means no end.
  Pacing(double rate_hz, double seconds) : rate_hz_(rate_hz), seconds_(seconds) {}

  /// Waits for the next turn; false when the time is over.
  bool next() {
    if (rate_hz_ > 0.0) std::this_thread::sleep_until(start_ + seconds(static_cast<double>(turns_) / rate_hz_));
    ++turns_;
    return seconds_ <= 0.0 || passed_s() < seconds_;
  }
  double passed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  static Clock::duration seconds(double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  }

  double rate_hz_, seconds_;
  std::uint64_t turns_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace azimuth::guest
