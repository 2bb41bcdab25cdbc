#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/ring.hpp"
#include "base/unique_fd.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

struct FifoSettings {
  std::string path = "/run/azimuth/odometry";  ///< created if it does not exist
  double silent_s = 1.0;                       ///< a writer that is silent for this long is reported as silent
};

struct FifoState : DeviceState {
  std::uint64_t refused = 0;  ///< number of refused lines
  std::string_view refusal;   ///< why the last line was refused; static text
};

/// Parses a line `stamp_s,x_m,y_m,heading_rad`, which may end in \r as on Windows; none for any other text. Thread
/// contract: reentrant.
std::optional<OdometryReading> parse_fifo_line(std::string_view line);

/// Odometry from another program, one line of text per reading: cumulative poses with stamps of CLOCK_MONOTONIC in
/// seconds (time.monotonic() in Python). For a thread that polls:
///
///   poll descriptor() for POLLIN, for due_in() at most; then turn();
///   then take() and take_event() until they return false.
///
/// Only one program writes at a time. Each program that opens the FIFO starts a new origin, because the earlier motion
/// of the robot is unknown to it. A step that wheels cannot make starts a new origin as well (OdometrySteps). Stamps
/// increase strictly.
///
/// Thread contract: thread-bound; nothing blocks. Allocates only to report a change, and to open the FIFO.
class FifoOdometer {
 public:
  using Clock = DeviceClock;

  /// Does not open the FIFO yet. Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`.
  FifoOdometer(FifoSettings settings, Duration epoch_minus_monotonic);

  int descriptor() const { return fifo_.get(); }  ///< to be polled; -1: none. It may change with every turn.
  /// Time until turn() is needed without any event; never negative.
  Clock::duration due_in(Clock::time_point now) const;
  void turn(Clock::time_point now);
  bool take(OdometryReading& reading) { return readings_.pop(reading); }  ///< takes the oldest reading
  void follow(std::uint32_t origin) { origin_ = origin; }                 ///< readings start after `origin`

  /// Takes the oldest message for the log about a change.
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
  Clock::time_point last_reading_{};  // time of the last reading, or of the opening
  BackOff back_off_;
  FifoState state_;
  Ring<OdometryReading, 64> readings_;
  DeviceNews news_;
};

}  // namespace azimuth
