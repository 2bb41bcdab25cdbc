#pragma once
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Selects which of a camera's images are taken when only a limited rate is wanted. A camera of just that rate loses no
/// image, although its stamps are slightly uneven.
///
/// Thread contract: thread-bound.
class FramePace {
 public:
  /// Takes at most `rate_hz` images per second; 0: all.
  explicit FramePace(double rate_hz)
      : interval_(rate_hz > 0.0 ? duration_from_seconds(1.0 / rate_hz) : Duration::zero()) {}

  /// True: the image with this stamp is taken.
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
