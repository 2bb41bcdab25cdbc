#pragma once
// The part of the controller that drives: what clients order, ramped, and stopped by the watchdog.

#include <optional>

#include "sim/pioneer/model.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// Speed of the robot over ground.
struct Twist {
  double speed_m_per_s = 0.0;
  double turn_rate_rad_per_s = 0.0;
  friend bool operator==(const Twist&, const Twist&) = default;
};

/// Whether a client drives, and how. Azimuth itself never does; other programs connect too.
///
/// Thread contract: thread-bound.
class Motors {
 public:
  explicit Motors(const PioneerModel& model) : model_(model) {}

  void enable(bool on);
  bool enabled() const { return enabled_; }
  void emergency_stop();
  bool emergency_stopped() const { return emergency_stopped_; }
  void order_speed(double speed_m_per_s);
  void order_turn_rate(double turn_rate_rad_per_s);
  void stop();
  /// The session is over: nobody drives any more.
  void release();

  /// The watchdog holds the wheels still; orders stand and are resumed.
  void hold(bool held) { held_ = held; }
  bool held() const { return held_; }

  /// Ramps towards what is ordered. `now` never decreases.
  void advance(Stamp now);

  /// The present motion, if a client has ordered any since the session began.
  std::optional<Twist> driven() const { return driving_ ? std::optional(present_) : std::nullopt; }

 private:
  bool may_turn() const { return enabled_ && !held_ && !emergency_stopped_; }

  PioneerModel model_;
  bool enabled_ = false, emergency_stopped_ = false, held_ = false, driving_ = false;
  Twist ordered_, present_;
  Stamp last_{};
};

}  // namespace azimuth::sim
