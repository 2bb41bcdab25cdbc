#pragma once
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Which of a camera's images are taken when only so many a second are wanted. A camera of just that rate, whose stamps
/// are never quite even, loses none.
///
/// Thread contract: thread-bound.
class FramePace {
 public:
  /// At most so many a second; 0: all.
  explicit FramePace(double rate_hz)
      : interval_(rate_hz > 0.0 ? duration_from_seconds(1.0 / rate_hz) : Duration::zero()) {}

  /// Whether the image of this stamp is one of them.
  bool takes(Stamp stamp) {
    const bool jumped = !begun_ || stamp > next_ + interval_ || stamp < next_ - 2 * interval_;
    if (!jumped && stamp < next_ - interval_ / 2) return false;
    next_ = (jumped ? stamp : next_) + interval_;
    begun_ = true;
    return true;
  }

 private:
  Duration interval_;
  Stamp next_{};
  bool begun_ = false;
};

}  // namespace azimuth
