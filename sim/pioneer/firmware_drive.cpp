// Commands that move the robot, and commands that set limits of the motion.

#include "sim/pioneer/firmware.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth::sim {

using pioneer::Command;

void Firmware::drive(Command command, int value) {
  switch (command) {
    case Command::enable:
      return motors_.enable(value != 0);
    case Command::velocity:
      return motors_.order_speed(value / 1000.0);
    case Command::rotate:
    case Command::rotation:
      return motors_.order_turn_rate(degrees_to_rad(value));
    case Command::move:
      return motors_.order_distance(value / 1000.0);
    case Command::heading:
      return motors_.order_turn(wrap(degrees_to_rad(value) - wheels_.heading_rad()));
    case Command::relative_heading:
      return motors_.order_turn(wrap(degrees_to_rad(value)));
    case Command::heading_from_set_point:
      return motors_.order_turn(wrap(degrees_to_rad(value) + motors_.turn_left_rad()));
    case Command::wheel_velocities:
      return drive_wheels(value);
    case Command::stop:
      return motors_.stop();
    case Command::emergency_stop:
      return motors_.emergency_stop();
    default:
      return limit(command, value);
  }
}

void Firmware::drive_wheels(int value) {
  constexpr double kDivisor_m_per_s = 0.020;  // Vel2Divisor
  const double right = kDivisor_m_per_s * static_cast<std::int8_t>(value & 0xFF);
  const double left = kDivisor_m_per_s * static_cast<std::int8_t>((value >> 8) & 0xFF);
  motors_.order_wheels(left, right);
}

/// The sign of an acceleration tells whether it is for speeding up or for slowing down.
void Firmware::limit(Command command, int value) {
  switch (command) {
    case Command::set_max_velocity:
      return motors_.limit(&MotionLimits::speed_mm_per_s, value);
    case Command::set_max_rotation:
      return motors_.limit(&MotionLimits::turn_rate_deg_per_s, value);
    case Command::set_acceleration:
      return motors_.limit(value < 0 ? &MotionLimits::deceleration_mm_per_s2 : &MotionLimits::acceleration_mm_per_s2,
                           value);
    case Command::set_rotation_acceleration:
      return motors_.limit(
          value < 0 ? &MotionLimits::turn_deceleration_deg_per_s2 : &MotionLimits::turn_acceleration_deg_per_s2, value);
    default:
      return;
  }
}

}  // namespace azimuth::sim
