#pragma once
#include <optional>

#include "sim/pioneer/motors.hpp"
#include "sim/pioneer/wheel_counter.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// The robot that carries the controller. It may also be driven without a client of this line, by another program.
class Chassis {
 public:
  virtual ~Chassis() = default;
  /// Motion of wheels and body since the last requested instant. Instants must not decrease.
  virtual WheelMotion roll_to(Stamp until) = 0;
  /// Sets the motion that a client orders; nullopt: no client drives.
  virtual void drive(const std::optional<Twist>& ordered) = 0;
  /// Sets the speed on straights of a robot that no client drives; 0: its own speed.
  virtual void hurry(double speed_m_per_s) = 0;
};

}  // namespace azimuth::sim
