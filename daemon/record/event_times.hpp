#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Assigns the times of a session's events [us since the epoch]. Consecutive events are at least kLeast_us apart. So a
/// player of the log keeps its pace, and a receiver's queue (30 messages by LCM's default) does not overflow. The
/// stamps inside the messages are not changed.
///
/// Live, the time of an event is the moment of its recording, on the clock of the stamps. The stamps of a played
/// recording may start anywhere. In that case the time starts with the session and advances with the stamps of the
/// recording's samples, at any playing speed; an event without a sample gets the time of the newest sample.
///
/// Thread contract: thread-bound; a copy starts at the same time as its original.
class EventTimes {
 public:
  /// `epoch_minus_monotonic` is the offset of the stamps from CLOCK_MONOTONIC.
  static EventTimes live(Duration epoch_minus_monotonic);
  /// `first` is the first stamp of the recording, which starts now.
  static EventTimes of_recording(Stamp first);

  /// The time of a sample that the session takes now.
  std::int64_t of_sample(Stamp stamp);
  /// The time of any other event that happens now.
  std::int64_t now();

  static constexpr std::int64_t kLeast_us = 500;  ///< shortest time between two events

 private:
  EventTimes(std::optional<Duration> epoch_minus_monotonic, std::int64_t begins_us)
      : epoch_minus_monotonic_(epoch_minus_monotonic), reached_us_(begins_us), last_us_(begins_us - kLeast_us) {}
  std::int64_t next();

  std::optional<Duration> epoch_minus_monotonic_;  // none: a recording is played
  Duration ahead_{};                               // offset from the recording's stamps to the session's time
  std::int64_t reached_us_, last_us_;              // latest time of samples or clock; time of the last event
};

}  // namespace azimuth
