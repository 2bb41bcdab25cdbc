#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/io/ring.hpp"
#include "drivers/io/unique_fd.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

struct FifoSettings {
  std::string path = "/run/azimuth/odometry";  ///< made if nothing is there
  double silent_s = 1.0;                       ///< a writer that writes nothing for so long is in trouble
};

/// Of a line `stamp_s,x_m,y_m,heading_rad`; nothing for any other text. Thread contract: reentrant.
std::optional<OdometryReading> parse_fifo_line(std::string_view line);

/// Odometry from another program, a line of text a reading: cumulative poses, stamped by CLOCK_MONOTONIC in seconds
/// (time.monotonic() in Python). For a thread that polls descriptor() for POLLIN: turn(); take() until it says no.
///
/// One program writes at a time. Each that opens the FIFO begins a new origin, since nobody knows how the robot went
/// before. Stamps increase strictly.
///
/// Thread contract: thread-bound; nothing blocks. Allocates only while it cannot be opened.
class FifoOdometer {
 public:
  using Clock = std::chrono::steady_clock;

  /// Opens nothing yet. Readings are stamped CLOCK_MONOTONIC plus `epoch_minus_monotonic`.
  FifoOdometer(FifoSettings settings, Duration epoch_minus_monotonic);

  int descriptor() const { return fifo_.get(); }  ///< -1: none at present. May change with every turn
  void turn(Clock::time_point now);
  bool take(OdometryReading& reading) { return readings_.pop(reading); }  ///< the oldest one not taken yet
  void follow(std::uint32_t origin) { origin_ = origin; }                 ///< readings begin after that one

  const std::string& trouble() const { return trouble_; }  ///< why it is not open; empty: it is
  std::uint64_t refused() const { return refused_; }       ///< lines of no use so far
  std::string_view refusal() const { return refusal_; }    ///< why, of the last one; static text

 private:
  void open();
  void accept(Stamp now);
  void refuse(std::string_view why);

  FifoSettings settings_;
  Duration epoch_minus_monotonic_;
  UniqueFd fifo_;
  std::string line_, trouble_;
  bool is_new_writer_ = true;
  Stamp newest_ = Stamp::min();
  std::uint32_t origin_ = 0;
  std::uint64_t sequence_ = 0, refused_ = 0;
  std::string_view refusal_;
  Ring<OdometryReading, 64> readings_;
};

}  // namespace azimuth
