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
/// The signals may come in one frame or in several, each at its own pace. They are paired by time: each is a line over
/// time, and a reading is of the newest instant at which all of them are known, the ones measured before and after
/// being interpolated. So frames close together give a reading as soon as the last of them is there, staggered ones
/// give no false turn, and a lost frame leaves no lasting shift.
///
/// Counters are differenced modulo their bits, so lost frames lose no motion. A base that begins to count anew, or
/// whose speeds were not heard of for `stale_s`, gets a new origin, and what it may have moved meanwhile is uncertain
/// (sigma_gap_m, sigma_gap_rad); so is the way over a gap.
///
/// Stamps increase strictly. There are at most 500 readings a second; frames between them lose no motion.
///
/// Thread contract: thread-bound; never allocates after construction.
class CanOdometer {
 public:
  /// `layout` must be that of find_can_layout(). `epoch_minus_monotonic` turns arrival times into stamps.
  CanOdometer(const CanLayout& layout, const CanSettings& settings, Duration epoch_minus_monotonic);

  /// Any frame, and when it came; foreign ones are ignored. Returns the reading it completes.
  std::optional<OdometryReading> add(const CanFrame& frame, DeviceClock::time_point at);

  /// What the next process needs to go on with the base's counters; speeds are none. False: there is nothing.
  bool remember(OdometerMemory& out) const;
  /// Before the first frame: readings go on where those of another process ended, unless the base's counters say that
  /// it began anew. False: this was remembered of other signals, and readings begin at the next origin.
  bool restore(const OdometerMemory& memory);
  /// Readings begin after that origin.
  void follow(std::uint32_t origin) { origin_ = first_origin_ = origin + 1; }

  double speed_m_s() const { return speed_m_s_; }                     ///< over the last reading's step
  std::uint64_t malformed() const { return malformed_; }              ///< signals too short, or not a finite number
  std::uint64_t missed() const;                                       ///< values that were due and did not come
  std::uint64_t doubted() const;                                      ///< values that could not be true
  std::uint64_t restarts() const { return origin_ - first_origin_; }  ///< of the base's counting
  std::uint64_t gaps() const { return gaps_; }                        ///< readings with more than the usual uncertainty

 private:
  static constexpr std::size_t kMostChannels = 3;
  using Values = std::array<double, kMostChannels>;
  /// The channels at one instant.
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
  std::optional<Instant> last_;                            // of this origin
  std::optional<DeviceClock::time_point> before_restart_;  // last instant of the origin before
  std::uint64_t missed_at_last_ = 0;
  Pose2 T_odom_body_;
  double sigma_m_ = 0.0, sigma_rad_ = 0.0;
  std::uint32_t origin_ = 1, first_origin_ = 1;
  std::uint64_t gaps_ = 0, malformed_ = 0;
  ReadingOrder order_;
  double speed_m_s_ = 0.0, turn_rad_s_ = 0.0;
};

}  // namespace azimuth
