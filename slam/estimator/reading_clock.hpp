#pragma once
#include <optional>

#include "slam/estimator/rig.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Converts the stamp of a reading to the instant, on the camera's clock, at which the robot was at the reading's pose:
/// later by the rig's lag, which may grow from the first reading on.
///
/// Thread contract: thread-bound. Nothing allocates.
class ReadingClock {
 public:
  explicit ReadingClock(const OdometryRig& rig) : lag_(duration_from_seconds(rig.lag_s)), drift_(rig.clock_drift) {}

  Duration lag_at_first() const { return lag_; }
  /// The first call must be for the first reading.
  Stamp instant_of(Stamp reading) {
    if (!first_) first_ = reading;
    const Stamp instant = reading + lag_;
    if (drift_ == 0.0) return instant;
    return instant + duration_from_seconds(drift_ * to_seconds(reading - *first_));
  }

 private:
  Duration lag_;
  double drift_;
  std::optional<Stamp> first_;
};

}  // namespace azimuth
