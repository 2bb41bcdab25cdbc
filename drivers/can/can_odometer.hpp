#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/can/can_channel.hpp"
#include "drivers/can/can_frame.hpp"
#include "drivers/can/can_layout.hpp"
#include "drivers/device/odometer_memory.hpp"
#include "drivers/device/reading_order.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Cumulative odometry from a base's frames: wheel ticks, wheel speeds or poses.
///
/// The signals may arrive in one frame or in several, at different rates. They are paired by time: each signal is a
/// line over time, and a reading belongs to the newest instant at which all signals are known, by interpolation between
/// the values before and after. So frames close together give a reading as soon as the last of them has arrived, frames
/// at different times cause no false turn, and a lost frame causes no lasting error.
///
/// Counters are differenced modulo their bits, so lost frames lose no motion. When the base restarts its counting, or
/// its speeds are missing for `stale_s`, the readings get a new origin, and the motion meanwhile is uncertain
/// (sigma_gap_m, sigma_gap_rad). The motion over a gap is uncertain in the same way.
///
/// Stamps increase strictly. There are at most 500 readings per second; skipped frames lose no motion.
///
/// Thread contract: thread-bound; never allocates after construction.
class CanOdometer {
 public:
  /// `layout` must come from find_can_layout(). `epoch_minus_monotonic` turns times of arrival into stamps.
  CanOdometer(const CanLayout& layout, const CanSettings& settings, Duration epoch_minus_monotonic);

  /// Takes any frame with its time of arrival; foreign frames are ignored. Returns the reading that the frame
  /// completes.
  std::optional<OdometryReading> add(const CanFrame& frame, DeviceClock::time_point at);

  /// Writes the state that the next process needs to continue with the base's counters. False: there is none. Wheel
  /// speeds never have one.
  bool remember(OdometerMemory& out) const;
  /// Called before the first frame. Readings continue where those of another process ended, unless the base's counters
  /// show that it restarted. False: the memory belongs to other signals, and readings start with the next origin.
  bool restore(const OdometerMemory& memory);
  /// Makes readings start after `origin`.
  void follow(std::uint32_t origin) { origin_ = first_origin_ = origin + 1; }

  /// Speed over the step of the last reading.
  double speed_m_s() const { return speed_m_s_; }
  /// Signals that were too short or not a finite number.
  std::uint64_t malformed() const { return malformed_; }
  /// Values that were due and did not arrive.
  std::uint64_t missed() const;
  /// Number of implausible values.
  std::uint64_t doubted() const;
  /// Restarts of the base's counting.
  std::uint64_t restarts() const { return origin_ - first_origin_; }
  /// Readings with more than the usual uncertainty.
  std::uint64_t gaps() const { return gaps_; }

 private:
  static constexpr std::size_t kMostChannels = 3;
  using Values = std::array<double, kMostChannels>;
  /// The values of all channels at one instant.
  struct Instant {
    DeviceClock::time_point at{};
    Values values{};
  };
  struct Heard {
    std::array<std::optional<CanValue>, kMostChannels> values;
    bool any = false, restarted = false;
  };

  Heard hear(const CanFrame& frame, DeviceClock::time_point at);
  void begin_anew(const Heard& heard, DeviceClock::time_point at);
  std::optional<Instant> newest_instant() const;
  Pose2 step(const Values& from, const Values& to) const;
  void step_sigma(const Pose2& T_last_body, double elapsed_s);
  void add_sigma(double sigma_m, double sigma_rad);
  void bridge_outage(DeviceClock::time_point at);
  OdometryReading reading(DeviceClock::time_point at);
  std::uint64_t signature() const;

  CanOdometryKind kind_;
  double track_m_, max_speed_m_s_, stale_s_;
  DeviceClock::duration latency_;
  Duration epoch_minus_monotonic_;
  std::vector<CanChannel> channels_;

  DeviceClock::time_point heard_at_{};
  std::optional<Instant> last_;                            // last instant of this origin
  std::optional<DeviceClock::time_point> before_restart_;  // last instant of the previous origin
  std::uint64_t missed_at_last_ = 0;
  Pose2 T_odom_body_;
  double sigma_m_ = 0.0, sigma_rad_ = 0.0;
  std::uint32_t origin_ = 1, first_origin_ = 1;
  std::uint64_t gaps_ = 0, malformed_ = 0;
  ReadingOrder order_;
  double speed_m_s_ = 0.0, turn_rad_s_ = 0.0;
};

}  // namespace azimuth
