#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "slam/sample/stamp.hpp"

namespace azimuth {

/// When the events of a session happen, in microseconds since the epoch. Each is a little later than the one ahead of
/// it, so that whoever plays the log keeps its pace, and nobody who listens is sent more at once than his queue holds
/// (30 messages by LCM's default). What the messages themselves say of time is left alone.
///
/// Live, that is the moment an event is recorded, on the clock of the stamps. A recording that is played may have
/// stamps that begin anywhere; its time begins when the session does, and goes on as its samples do, at whatever speed
/// they are played: what is published happens when the newest sample did.
///
/// Thread contract: thread-bound; copies have the same beginning.
class EventTimes {
 public:
  /// `epoch_minus_monotonic` is what stamps lead CLOCK_MONOTONIC by.
  static EventTimes live(Duration epoch_minus_monotonic);
  /// `first` is the recording's first stamp; it begins now.
  static EventTimes of_recording(Stamp first);

  /// Of a sample that the session takes now.
  std::int64_t of_sample(Stamp stamp);
  /// Of anything else that happens now.
  std::int64_t now();

  static constexpr std::int64_t kLeast_us = 500;  ///< between two events

 private:
  EventTimes(std::optional<Duration> epoch_minus_monotonic, std::int64_t begins_us)
      : epoch_minus_monotonic_(epoch_minus_monotonic), reached_us_(begins_us), last_us_(begins_us - kLeast_us) {}
  std::int64_t next();

  std::optional<Duration> epoch_minus_monotonic_;  // none: a recording is played
  Duration ahead_{};                               // of the recording's stamps
  std::int64_t reached_us_, last_us_;              // by the samples or the clock; by the events
};

}  // namespace azimuth
