#pragma once
// When frames were taken, and how many were not: what libdc1394 does not say. Internal to drivers/iidc; no clock here.

#include <cstdint>
#include <optional>

#include "slam/sample/stamp.hpp"

namespace azimuth::iidc {

/// Both clocks, read together.
struct ClockReading {
  std::int64_t wall_us = 0;       ///< CLOCK_REALTIME
  std::int64_t monotonic_us = 0;  ///< CLOCK_MONOTONIC
};

/// Turns libdc1394's stamps, which are on the wall clock, into stamps on CLOCK_MONOTONIC: what the wall clock says of a
/// frame's age when it is taken off the ring is taken from the monotonic clock. The wall clock may be stepped at any
/// time: frames that were waiting when that is noticed, and stamps that cannot be true (none at all, in the future, or
/// more than ten seconds old), get the time at which they were taken off.
///
/// Thread contract: thread-bound.
class StampClock {
 public:
  explicit StampClock(const ClockReading& now) : last_(now) {}

  Stamp monotonic(std::uint64_t wall_us, const ClockReading& now);
  /// No frame is waiting: those to come are younger than any step of the wall clock noticed so far.
  void drained(const ClockReading& now);

 private:
  void watch_for_step(const ClockReading& now);

  ClockReading last_;
  bool stepped_ = false;
};

/// Numbers frames as the camera must have counted them, from their stamps: libdc1394 hands on no number, and a frame
/// that found no room in the ring leaves no trace but the time it takes. A frame that comes n intervals after its
/// predecessor counts n; one that comes late by less than half an interval counts one.
///
/// The interval is first the one agreed with the camera, then that which the frames keep: when kSteady frames in a row
/// have kept another, within a tenth, it is believed, so that a camera whose long exposure slows it down is not taken
/// for one that loses frames all the time. Where no interval is known frames count one each until then.
///
/// Thread contract: thread-bound.
class FrameCounter {
 public:
  static constexpr int kSteady = 8;

  /// `rate_hz` as agreed; 0: unknown.
  explicit FrameCounter(double rate_hz) : interval_us_(rate_hz > 0 ? 1e6 / rate_hz : 0.0) {}

  /// The sequence number of the frame with this stamp; the first one's is 0.
  std::uint64_t next(Stamp stamp);

 private:
  void learn(double before_us, double now_us);

  double interval_us_;  // 0: unknown
  double steady_since_us_ = 0.0;
  int steady_frames_ = 0;  // that kept the same interval since then
  std::optional<Stamp> last_;
  double expected_us_ = 0.0;  // when the last frame should have come, from its predecessors
  std::uint64_t sequence_ = 0;
};

}  // namespace azimuth::iidc
