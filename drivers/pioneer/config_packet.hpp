#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

/// CONFIGpac: the controller's parameters. Older firmware sends a shorter packet; missing fields keep their default
/// values.
struct ConfigPacket {
  std::string robot_class, subclass, serial_number, name, firmware_version;

  /// The largest values that the limits can be set to.
  struct Top {
    std::uint16_t rotation_deg_per_s = 0, velocity_mm_per_s = 0;
    std::uint16_t rotation_acceleration_deg_per_s2 = 0, acceleration_mm_per_s2 = 0;
    friend bool operator==(const Top&, const Top&) = default;
  };
  Top top;
  /// The current limits.
  struct Limits {
    std::uint16_t rotation_deg_per_s = 0, velocity_mm_per_s = 0;
    friend bool operator==(const Limits&, const Limits&) = default;
  };
  Limits limits;
  /// The parameters of a motion controller.
  struct Control {
    std::uint16_t acceleration = 0, deceleration = 0, kp = 0, kv = 0, ki = 0;
    friend bool operator==(const Control&, const Control&) = default;
  };
  Control rotation, translation;
  struct Stall {
    std::uint16_t value = 0, count = 0;
    friend bool operator==(const Stall&, const Stall&) = default;
  };
  Stall stall;
  struct Joystick {
    std::uint16_t velocity = 0, rotation = 0;
    friend bool operator==(const Joystick&, const Joystick&) = default;
  };
  Joystick joystick;
  std::uint16_t pwm_max = 0;
  /// MTX controllers send further fields after this one; they are not read.
  std::uint8_t kinematics_delay_ms = 0;

  /// The built-in devices.
  struct Equipment {
    std::uint8_t four_motors = 0;
    std::uint16_t gripper = 0, front_sonar = 0;
    std::uint8_t rear_sonar = 0, front_bumpers = 0, rear_bumpers = 0, charger = 0;
    friend bool operator==(const Equipment&, const Equipment&) = default;
  };
  Equipment equipment;
  struct Battery {
    std::uint16_t low_decivolts = 0, shutdown_decivolts = 0;
    friend bool operator==(const Battery&, const Battery&) = default;
  };
  Battery battery;

  /// Difference of the wheels' ticks over one turn in place. It is not reliable without calibration.
  std::uint16_t rev_count = 0;
  std::uint16_t ticks_per_mm = 0;  ///< 0: not reported
  /// kGyroAnalog: GYROpacs are sent on request. Larger values: the firmware corrects the heading by its gyro.
  std::uint8_t gyro = 0;
  struct GyroFactors {
    std::int16_t drift = 0;
    std::uint16_t clockwise = 0, counter_clockwise = 0;
    friend bool operator==(const GyroFactors&, const GyroFactors&) = default;
  };
  GyroFactors gyro_factors;

  /// Codes of baud rates, see baud_code().
  struct BaudCodes {
    std::uint8_t host = 0, aux1 = 0, aux2 = 0, aux3 = 0;
    friend bool operator==(const BaudCodes&, const BaudCodes&) = default;
  };
  BaudCodes baud_codes;
  /// The value kAutoBaudResets means that the controller returns to its start baud rate when a session ends.
  std::uint8_t auto_baud = 0;
  std::uint8_t sip_cycle_ms = 100, sonar_cycle = 0;
  std::uint8_t p2mpacs = 0;
  std::uint16_t watchdog_ms = 2000;  ///< the wheels stop after this time without a command

  static constexpr std::uint8_t kAutoBaudResets = 2, kGyroAnalog = 1;
  friend bool operator==(const ConfigPacket&, const ConfigPacket&) = default;
};

/// None when `data` is not a CONFIGpac, or ends before sip_cycle_ms.
std::optional<ConfigPacket> decode_config(ByteView data);

/// Fields that do not fit into one packet are omitted, together with all fields after them.
Frame encode_config(const ConfigPacket& config);

/// True: `data` can be the parameters of a robot. Used for firmware that sends CONFIGpac with a wrong checksum. Texts
/// must be printable; velocities, cycle and watchdog must be in realistic ranges.
bool is_plausible_config(ByteView data);

}  // namespace azimuth::pioneer
