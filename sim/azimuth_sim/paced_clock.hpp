#pragma once
#include <chrono>

#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// Virtual time that runs with the real clock at a given speed.
///
/// Thread contract: reentrant.
class PacedClock {
 public:
  using Monotonic = std::chrono::steady_clock;

  /// Virtual time 0 is at `start`. `speed` must be positive.
  PacedClock(Monotonic::time_point start, Duration epoch_minus_monotonic, double speed)
      : start_(start), epoch_minus_monotonic_(epoch_minus_monotonic), speed_(speed) {}

  Stamp to_virtual(Monotonic::time_point now) const {
    const double passed_s = std::chrono::duration<double>(now - start_).count();
    return Stamp(duration_from_seconds(passed_s * speed_));
  }
  Monotonic::time_point to_monotonic(Stamp stamp) const {
    const std::chrono::duration<double, std::micro> passed(static_cast<double>(to_us(stamp)) / speed_);
    return start_ + std::chrono::ceil<std::chrono::nanoseconds>(passed);
  }
  /// Converts a stamp to CLOCK_MONOTONIC, on which the stamps of the camera link are.
  Stamp monotonic_stamp(Stamp stamp) const {
    return Stamp(std::chrono::floor<Duration>(to_monotonic(stamp).time_since_epoch()));
  }
  /// Converts a stamp to the time since the Unix epoch, like the stamps of a daemon that reads this robot.
  Stamp epoch_stamp(Stamp stamp) const { return monotonic_stamp(stamp) + epoch_minus_monotonic_; }

 private:
  Monotonic::time_point start_;
  Duration epoch_minus_monotonic_;
  double speed_;
};

}  // namespace azimuth::sim
