#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Dates and numbers an odometer's readings.
///
/// Thread contract: thread-bound.
class ReadingOrder {
 public:
  /// Of `stamp`, or of the first moment after the reading before: clocks are corrected, odometry only goes on.
  OdometryReading next(Stamp stamp) {
    OdometryReading reading;
    reading.stamp = newest_ ? std::max(stamp, *newest_ + Duration{1}) : stamp;
    newest_ = reading.stamp;
    reading.sequence = sequence_++;
    return reading;
  }

 private:
  std::uint64_t sequence_ = 0;
  std::optional<Stamp> newest_;
};

}  // namespace azimuth
