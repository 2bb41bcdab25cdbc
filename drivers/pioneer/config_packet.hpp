#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

/// CONFIGpac: the controller's parameters. Older firmware ends the packet early; what is missing keeps the value here.
struct ConfigPacket {
  std::string robot_class, subclass, serial_number;
  std::uint8_t four_motors = 0;
  std::uint16_t rotation_top_deg_per_s = 0, velocity_top_mm_per_s = 0;
  std::uint16_t rotation_acceleration_top_deg_per_s2 = 0, acceleration_top_mm_per_s2 = 0;
  std::uint16_t pwm_max = 0;
  std::string name;
  std::uint8_t sip_cycle_ms = 100;
  std::uint8_t host_baud = 0, aux1_baud = 0;  ///< codes, see baud_code()
  std::uint16_t has_gripper = 0, front_sonar = 0;
  std::uint8_t rear_sonar = 0;
  std::uint16_t low_battery_decivolts = 0;
  std::uint16_t rev_count = 0;  ///< difference of the wheels' ticks over a turn in place; calibrate before trusting it
  std::uint16_t watchdog_ms = 2000;  ///< without a command for so long the wheels stop
  std::uint8_t p2mpacs = 0;
  std::uint16_t stall_value = 0, stall_count = 0, joystick_velocity = 0, joystick_rotation = 0;
  std::uint16_t rotation_max_deg_per_s = 0, velocity_max_mm_per_s = 0;
  std::uint16_t rotation_acceleration = 0, rotation_deceleration = 0, rotation_kp = 0, rotation_kv = 0, rotation_ki = 0;
  std::uint16_t acceleration = 0, deceleration = 0, translation_kp = 0, translation_kv = 0, translation_ki = 0;
  std::uint8_t front_bumpers = 0, rear_bumpers = 0, charger = 0, sonar_cycle = 0;
  std::uint8_t auto_baud = 0;  ///< kAutoBaudResets: the controller goes back to its start baud when a session ends
  std::uint8_t gyro = 0;       ///< kGyroAnalog: GYROpacs on request; anything above: firmware corrects the heading
  std::int16_t drift_factor = 0;
  std::uint8_t aux2_baud = 0, aux3_baud = 0;
  std::uint16_t ticks_per_mm = 0;  ///< 0: not said
  std::uint16_t shutdown_decivolts = 0;
  std::string firmware_version;
  std::uint16_t gyro_clockwise = 0, gyro_counter_clockwise = 0;
  std::uint8_t kinematics_delay_ms = 0;  ///< what MTX controllers send after this is left alone

  static constexpr std::uint8_t kAutoBaudResets = 2, kGyroAnalog = 1;
  friend bool operator==(const ConfigPacket&, const ConfigPacket&) = default;
};

/// Nothing when `data` is no CONFIGpac or ends before sip_cycle_ms.
std::optional<ConfigPacket> decode_config(ByteView data);

/// Fields that do not fit into one packet are left out, and all after them.
Frame encode_config(const ConfigPacket& config);

/// Whether `data` reads as the parameters of a robot: for firmware that sends CONFIGpac with a wrong checksum. Texts
/// printable, velocities, cycle and watchdog in a range that exists.
bool is_plausible_config(ByteView data);

}  // namespace azimuth::pioneer
