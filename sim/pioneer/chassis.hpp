#pragma once
#include <optional>

#include "sim/pioneer/motors.hpp"
#include "sim/pioneer/wheel_counter.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// The robot the controller sits in. Somebody may drive it without a client of this line: another program.
class Chassis {
 public:
  virtual ~Chassis() = default;
  /// What wheels and body did since the instant asked for last. Instants never decrease.
  virtual WheelMotion roll_to(Stamp until) = 0;
  /// From now on a client drives like this; nothing: no client drives.
  virtual void drive(const std::optional<Twist>& ordered) = 0;
  /// Whoever drives without a client keeps to this speed on straights; 0: to their own.
  virtual void hurry(double speed_m_per_s) = 0;
};

}  // namespace azimuth::sim
