#pragma once
#include <cstdint>
#include <optional>

#include "drivers/can/can_layout.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// The quantity that a channel's signal measures.
enum class CanQuantity {
  /// A counter or a coordinate, modulo the signal's bits.
  way,
  heading,  ///< modulo a turn, modulo the signal's bits, or both
  speed
};

/// One quantity of a base as a continuous function of time: counters and headings are unwrapped, speeds are integrated.
///
/// A value that is farther away than the robot can have moved is ignored until the next value agrees with it. Then the
/// base has restarted its counting.
///
/// Thread contract: thread-bound; never allocates.
class CanChannel {
 public:
  using time_point = DeviceClock::time_point;
  CanChannel(const CanMotionSignal& motion, CanQuantity quantity, double stale_s)
      : motion_(motion), quantity_(quantity), stale_s_(stale_s) {}

  const CanSignal& signal() const { return motion_.signal; }

  /// True: the value can be used for computation. A float may hold anything.
  bool is_sane(const CanValue& value) const;

  enum class Taken { used, doubted, restarted };
  /// Adds a value; `at` never decreases. After `restarted`, the quantity is no longer comparable with earlier values,
  /// and begin() must follow.
  Taken add(const CanValue& value, time_point at);
  /// Forgets everything except this value.
  void begin(const CanValue& value, time_point at);
  void forget();

  /// The newest value, and the quantity it corresponds to.
  struct Memory {
    CanValue value;
    time_point at{};
    double quantity = 0.0;
  };
  std::optional<Memory> memory() const;
  /// Replaces begin(): continues the channel of another process, without any value since.
  void restore(const Memory& memory);

  /// The time of the newest value.
  std::optional<time_point> newest_at() const;
  /// The quantity at `instant`, linearly interpolated between values; none when it is not measured yet, or too old.
  std::optional<double> at(time_point instant) const;

  /// Standard deviation of the quantity's change since the last call, in addition to the usual noise.
  double take_sigma();
  /// Number of values that did not arrive in time, estimated from the times of the values that did.
  std::uint64_t missed() const { return missed_; }
  /// Number of implausible values, which were ignored.
  std::uint64_t doubted() const { return doubted_; }

 private:
  using Point = Memory;
  double step(const CanValue& newer, const CanValue& older) const;
  bool is_possible(double step, double elapsed_s) const;
  bool has_begun_anew(const CanValue& value, double elapsed_s) const;
  Taken add_speed(const CanValue& value, time_point at, double elapsed_s);
  Taken doubt(const CanValue& value, time_point at);
  void follow_cycle(double elapsed_s, double from, double to);
  double gap_sigma(double elapsed_s, double from, double to) const;
  double range() const;

  CanMotionSignal motion_;
  CanQuantity quantity_;
  double stale_s_;
  std::optional<Point> newest_, before_, doubtful_;
  bool restored_ = false;  // no value has arrived since restore()
  double cycle_s_ = 0.0;   // median time between values
  double sigma_ = 0.0;
  std::uint64_t missed_ = 0, doubted_ = 0;
};

}  // namespace azimuth
