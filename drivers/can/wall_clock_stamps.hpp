#pragma once
#include <chrono>

#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// Converts the kernel's receive stamps, which are on the wall clock, to CLOCK_MONOTONIC.
///
/// The wall clock may be set between the arrival of a frame and its reading. The stamp is then wrong by that step, so
/// the difference of the two clocks before the step is tried as well. A stamp that fits neither is replaced by the
/// current time.
///
/// Thread contract: thread-bound; never allocates.
class WallClockStamps {
 public:
  using Wall = std::chrono::nanoseconds;  ///< since the Unix epoch

  /// Takes both clocks, read together, before frames are read.
  void look(Wall wall_now, DeviceClock::time_point now);
  /// To be called when all frames that arrived before `now` have been read, so that later frames are younger.
  void note_empty(DeviceClock::time_point now) { empty_at_ = now; }

  /// The time of arrival of a frame, by the clocks of the last look(). Never later than that look.
  DeviceClock::time_point monotonic(Wall stamp);
  std::uint64_t replaced() const { return replaced_; }  ///< implausible stamps

 private:
  bool can_be(DeviceClock::time_point at) const;

  DeviceClock::time_point now_{}, empty_at_{};
  std::chrono::nanoseconds monotonic_minus_wall_{}, before_{};
  std::uint64_t replaced_ = 0;
};

}  // namespace azimuth
