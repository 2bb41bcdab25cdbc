#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/ring.hpp"
#include "base/unique_fd.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/device_news.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

struct FifoSettings {
  std::string path = "/run/azimuth/odometry";  ///< made if nothing is there
  double silent_s = 1.0;                       ///< a writer that writes nothing for so long is in trouble
};

struct FifoState : DeviceState {
  std::uint64_t refused = 0;  ///< lines of no use so far
  std::string_view refusal;   ///< why, of the last one; static text
};

/// Of a line `stamp_s,x_m,y_m,heading_rad`, which may end in \r as on Windows; nothing for any other text. Thread
/// contract: reentrant.
std::optional<OdometryReading> parse_fifo_line(std::string_view line);

/// Odometry from another program, a line of text a reading: cumulative poses, stamped by CLOCK_MONOTONIC in seconds
/// (time.monotonic() in Python). For a thread that polls:
///
///   poll descriptor() for POLLIN, for due_in() at most; turn(); take() and take_event() until they say no.
///
/// One program writes at a time. Each that opens the FIFO begins a new origin, since nobody knows how the robot went
/// before, and so does a step that no wheels make (OdometrySteps). Stamps increase strictly.
///
/// Thread contract: thread-bound; nothing blocks. Allocates only to tell of a change, and to open it.
class FifoOdometer {
 public:
  using Clock = DeviceClock;

  /// Opens nothing yet. Readings are stamped CLOCK_MONOTONIC plus `epoch_minus_monotonic`.
  FifoOdometer(FifoSettings settings, Duration epoch_minus_monotonic);

  int descriptor() const { return fifo_.get(); }        ///< -1: none at present. May change with every turn
  Clock::duration due_in(Clock::time_point now) const;  ///< until turn() is wanted without any event; never negative
  void turn(Clock::time_point now);
  bool take(OdometryReading& reading) { return readings_.pop(reading); }  ///< the oldest one not taken yet
  void follow(std::uint32_t origin) { origin_ = origin; }                 ///< readings begin after that one

  /// A sentence for the log about a change, oldest first.
  bool take_event(std::string& event) { return news_.take(event); }

  const FifoState& state() const { return state_; }

 private:
  void open(Clock::time_point now);
  void accept(Clock::time_point now);
  void refuse(std::string_view why);
  void watch_silence(Clock::time_point now);

  FifoSettings settings_;
  Duration epoch_minus_monotonic_;
  UniqueFd fifo_;
  std::string line_;
  bool is_new_writer_ = true;
  Stamp newest_ = Stamp::min();
  std::uint32_t origin_ = 0;
  std::uint64_t sequence_ = 0;
  OdometrySteps steps_;
  Clock::time_point last_reading_{};  // or when it was opened
  BackOff back_off_;
  FifoState state_;
  Ring<OdometryReading, 64> readings_;
  DeviceNews news_;
};

}  // namespace azimuth
