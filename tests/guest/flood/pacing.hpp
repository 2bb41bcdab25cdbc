#pragma once
#include <chrono>
#include <cstdint>
#include <thread>

namespace azimuth::guest {

/// Something done over and over, at a rate or as often as possible, for a time.
///
/// Thread contract: thread-bound.
class Pacing {
 public:
  /// `rate_hz` 0: no pause between turns. `seconds` 0: without end.
  Pacing(double rate_hz, double seconds) : rate_hz_(rate_hz), seconds_(seconds) {}

  /// Waits for the next turn. False: time is up.
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
