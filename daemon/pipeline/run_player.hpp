#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "daemon/pipeline/doorbell.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// A recorded run's samples, each kind in the order of its stamps. Either bearings or frames.
struct Recording {
  std::vector<OdometryReading> odometry;
  std::vector<BearingSet> bearings;
  std::vector<Stamp> frames = {};  ///< when images were taken; they themselves stay on the disk
};

/// Plays a recording: says which sample is due, and when the next one will be.
///
/// Samples come in the order of their stamps, odometry before bearings or frames of the same stamp: whoever is given a
/// bearing set has been given all odometry up to its instant, whatever the speed.
///
/// Thread contract: thread-bound, except finished(), which any thread may ask. Nothing allocates after construction.
class RunPlayer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `speed` 1 is the recording's own pace, 2 twice as fast, 0 as fast as possible.
  RunPlayer(Recording recording, double speed);

  /// The next sample: exactly one of the three is there, or none when the recording is over.
  struct Sample {
    const OdometryReading* odometry = nullptr;
    BearingSet* bearings = nullptr;         ///< may be swapped away: it will not be asked for again
    std::optional<std::size_t> frame = {};  ///< by its index
    Stamp stamp{};
  };
  Sample peek();

  /// Time until the sample peeked at is due, at most `limit`; not positive: now. The first question starts the clock.
  std::chrono::nanoseconds due_in(Clock::time_point now, std::chrono::nanoseconds limit);

  /// Goes on to the sample after the one peeked at.
  void advance();

  bool over() const {
    return next_odometry_ == recording_.odometry.size() && next_set_ == recording_.bearings.size() &&
           next_frame_ == recording_.frames.size();
  }

 private:
  Recording recording_;
  double speed_;
  std::size_t next_odometry_ = 0, next_set_ = 0, next_frame_ = 0;
  bool started_ = false;
  Clock::time_point start_{};
  Stamp first_stamp_{};
};

}  // namespace azimuth
