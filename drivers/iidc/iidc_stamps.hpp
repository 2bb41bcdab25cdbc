#pragma once
// Stamps and sequence numbers of frames, which libdc1394 does not provide exactly. Internal to drivers/iidc. Reads no
// clock.

#include <cstdint>
#include <optional>

#include "slam/sample/stamp.hpp"

namespace azimuth::iidc {

/// The wall clock and the monotonic clock, read at the same instant.
struct ClockReading {
  std::int64_t wall_us = 0;       ///< CLOCK_REALTIME
  std::int64_t monotonic_us = 0;  ///< CLOCK_MONOTONIC
};

/// Converts libdc1394's stamps, which are on the wall clock, to CLOCK_MONOTONIC. The age of a frame when it is taken
/// off the ring is computed on the wall clock and subtracted from the monotonic clock. The wall clock may be stepped at
/// any time. Frames that are waiting when a step is noticed get the time at which they are taken off. So do frames with
/// implausible stamps (zero, in the future, or more than ten seconds old).
///
/// Thread contract: thread-bound.
class StampClock {
 public:
  explicit StampClock(const ClockReading& now) : last_(now) {}

  Stamp monotonic(std::uint64_t wall_us, const ClockReading& now);
  /// To be called when no frame is waiting, so that all further frames are younger than any step of the wall clock
  /// noticed so far.
  void drained(const ClockReading& now);

 private:
  void watch_for_step(const ClockReading& now);

  ClockReading last_;
  bool stepped_ = false;
};

/// Reconstructs the camera's frame numbers from the stamps, because libdc1394 delivers no number, and a frame that
/// finds no room in the ring leaves only a gap in time. A frame that comes n intervals after its predecessor advances
/// the number by n; a frame that is late by less than half an interval advances it by one.
///
/// The interval is at first the one agreed with the camera. When kSteady consecutive frames have kept another interval,
/// within a tenth, the kept interval is used. So a camera that is slowed down by a long exposure is not taken for one
/// that keeps losing frames. While no interval is known, each frame advances the number by one.
///
/// Thread contract: thread-bound.
class FrameCounter {
 public:
  static constexpr int kSteady = 8;

  /// `rate_hz` is the agreed rate; 0: unknown.
  explicit FrameCounter(double rate_hz) : interval_us_(rate_hz > 0 ? 1e6 / rate_hz : 0.0) {}

  /// The sequence number of the frame with this stamp; the first one's is 0.
  std::uint64_t next(Stamp stamp);

 private:
  void learn(double before_us, double now_us);

  double interval_us_;  // 0: unknown
  double steady_since_us_ = 0.0;
  int steady_frames_ = 0;  // frames that kept the same interval since steady_since_us_
  std::optional<Stamp> last_;
  double expected_us_ = 0.0;  // expected time of the last frame according to its predecessors
  std::uint64_t sequence_ = 0;
};

}  // namespace azimuth::iidc
