#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Assigns stamps and sequence numbers to an odometer's readings.
///
/// Thread contract: thread-bound.
class ReadingOrder {
 public:
  /// The reading gets `stamp`, or the first instant after the previous reading if `stamp` is not later. Clocks may be
  /// corrected backwards, but the stamps of odometry must increase.
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
