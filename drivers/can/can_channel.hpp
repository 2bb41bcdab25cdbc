#pragma once
#include <cstdint>
#include <optional>

#include "drivers/can/can_layout.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// What a channel's signal measures.
enum class CanQuantity {
  way,      ///< a counter or a coordinate, modulo its bits
  heading,  ///< modulo a turn, or modulo its bits, or both
  speed
};

/// One quantity of a base as a function of time, even: counters and headings are unwrapped, speeds integrated.
///
/// A value that is farther off than the robot can have moved is not believed until the next one agrees with it: then
/// the base has begun to count anew.
///
/// Thread contract: thread-bound; never allocates.
class CanChannel {
 public:
  using time_point = DeviceClock::time_point;
  CanChannel(const CanMotionSignal& motion, CanQuantity quantity, double stale_s)
      : motion_(motion), quantity_(quantity), stale_s_(stale_s) {}

  const CanSignal& signal() const { return motion_.signal; }

  /// Whether it can be calculated with: a float may be anything.
  bool is_sane(const CanValue& value) const;

  enum class Taken { used, doubted, restarted };
  /// `at` never decreases. After `restarted` nothing of the way before is comparable; begin() is to follow.
  Taken add(const CanValue& value, time_point at);
  /// Forgets all but this value.
  void begin(const CanValue& value, time_point at);
  void forget();

  /// The newest value, and the quantity that it stands for.
  struct Memory {
    CanValue value;
    time_point at{};
    double quantity = 0.0;
  };
  std::optional<Memory> memory() const;
  /// Instead of begin(): of another process's channel, which has heard nothing since.
  void restore(const Memory& memory);

  /// The instant of the newest value.
  std::optional<time_point> newest_at() const;
  /// The quantity then, between values on a straight line; nothing when it was not measured yet, or too long ago.
  std::optional<double> at(time_point instant) const;

  /// What is uncertain of the way since the last call, beyond noise (standard deviation).
  double take_sigma();
  std::uint64_t missed() const { return missed_; }    ///< values that did not come in time, by those that did
  std::uint64_t doubted() const { return doubted_; }  ///< values that could not be true

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
  bool restored_ = false;  // and no value came since
  double cycle_s_ = 0.0;   // between values, the median
  double sigma_ = 0.0;
  std::uint64_t missed_ = 0, doubted_ = 0;
};

}  // namespace azimuth
