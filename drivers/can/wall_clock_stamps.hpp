#pragma once
#include <chrono>

#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// Turns the kernel's receive stamps, which are of the wall clock, into those of CLOCK_MONOTONIC.
///
/// Somebody may set the wall clock between a frame's arrival and our look at it. Then its stamp is off by that step; so
/// the step before is tried as well, and a stamp that fits neither is replaced by now.
///
/// Thread contract: thread-bound; never allocates.
class WallClockStamps {
 public:
  using Wall = std::chrono::nanoseconds;  ///< since the Unix epoch

  /// Both clocks, read together, before frames are read.
  void look(Wall wall_now, DeviceClock::time_point now);
  /// All frames that came before `now` have been read: later ones are younger.
  void note_empty(DeviceClock::time_point now) { empty_at_ = now; }

  /// When a frame came, with the clocks as looked at last. Never later than that look.
  DeviceClock::time_point monotonic(Wall stamp);
  std::uint64_t replaced() const { return replaced_; }  ///< stamps that could not be true

 private:
  bool can_be(DeviceClock::time_point at) const;

  DeviceClock::time_point now_{}, empty_at_{};
  std::chrono::nanoseconds monotonic_minus_wall_{}, before_{};
  std::uint64_t replaced_ = 0;
};

}  // namespace azimuth
