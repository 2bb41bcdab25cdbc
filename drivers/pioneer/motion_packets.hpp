#pragma once
// The packets with the motion of the robot: the standard SIP, and those that the robot sends on request in addition,
// wheel ticks and the analog gyro.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/protocol.hpp"

namespace azimuth::pioneer {

/// The standard server information packet: the robot's report of each cycle, in its own units (RobotParameters converts
/// them to metres and radians).
struct StandardSip {
  /// Bits of `flags`.
  static constexpr unsigned kMotorsEnabled = 1U << 0U, kEmergencyStop = 1U << 5U;

  struct SonarReading {
    std::uint8_t index = 0;
    std::uint16_t range_units = 0;
    friend bool operator==(const SonarReading&, const SonarReading&) = default;
  };
  static constexpr std::size_t kMaxSonars = (kMaxDataSize - 20) / 3;

  std::uint8_t id = packet_id::sip_stopped;
  std::uint16_t x_units = 0, y_units = 0;  ///< counters; only 15 of their bits are reliable
  std::int16_t heading_units = 0;
  std::int16_t left_velocity_units = 0, right_velocity_units = 0;
  std::uint8_t battery_decivolts = 0;
  std::uint8_t left_stall_and_rear_bumpers = 0;    ///< bit 0 stall, bits 1 to 7 bumpers
  std::uint8_t right_stall_and_front_bumpers = 0;  ///< bit 0 stall, bits 1 to 7 bumpers
  std::int16_t control_units = 0;                  ///< heading that the controller aims at
  std::uint16_t flags = 0;
  std::uint8_t compass_2deg = 0;
  std::uint8_t sonar_count = 0;
  std::array<SonarReading, kMaxSonars> sonars{};  ///< only new readings

  // The fields below are optional. Firmware may end the packet after any of them.
  /// The state of the controller's other inputs and outputs.
  struct Ports {
    std::optional<std::uint8_t> grip_state, analog_port, analog, digital_in, digital_out;
    friend bool operator==(const Ports&, const Ports&) = default;
  };
  Ports ports;
  std::optional<std::uint16_t> battery_x10_decivolts;
  /// 0 not charging, 1 bulk, 2 overcharge, 3 float, 4 balance, 255 unknown.
  std::optional<std::uint8_t> charge_state;
  std::optional<std::int16_t> rotation_ddeg_per_s;
  std::optional<std::uint16_t> fault_flags;
  std::optional<std::int16_t> lateral_velocity_mm_per_s;
  std::optional<std::int8_t> temperature_C;  ///< -127 and -128: no sensor
  std::optional<std::int8_t> charge_percent;
  std::optional<std::uint32_t> time_us;
  std::optional<std::uint32_t> flags3;

  bool left_stall() const { return (left_stall_and_rear_bumpers & 1U) != 0; }
  bool right_stall() const { return (right_stall_and_front_bumpers & 1U) != 0; }
  std::uint8_t rear_bumpers() const { return static_cast<std::uint8_t>(left_stall_and_rear_bumpers >> 1U); }
  std::uint8_t front_bumpers() const { return static_cast<std::uint8_t>(right_stall_and_front_bumpers >> 1U); }
  bool motors_enabled() const { return (flags & kMotorsEnabled) != 0; }
  bool emergency_stop() const { return (flags & kEmergencyStop) != 0; }
  /// Uses the wider field if it is present, because 24 V batteries exceed the range of the narrow one.
  double battery_volts() const {
    return 0.1 * (battery_x10_decivolts && *battery_x10_decivolts > 0 ? *battery_x10_decivolts : battery_decivolts);
  }

  friend bool operator==(const StandardSip&, const StandardSip&) = default;
};

/// None when `data` is not a standard SIP, or ends before the sonar count.
std::optional<StandardSip> decode_sip(ByteView data);

/// Writes the optional fields up to the first missing one, and as many sonars as fit.
Frame encode_sip(const StandardSip& sip);

/// ENCODERpac: cumulative ticks of the wheels, modulo 2^32. The firmware's gyro correction does not affect them.
struct EncoderPacket {
  std::int32_t left_ticks = 0, right_ticks = 0;
  friend bool operator==(const EncoderPacket&, const EncoderPacket&) = default;
};

/// GYROpac: the rates of one cycle, one sample every kGyroSamplePeriod_s. It comes before the SIP of its cycle.
struct GyroPacket {
  struct Sample {
    std::uint16_t rate = 0;  ///< 0 to 1023, about 512 at rest, larger when turning clockwise
    std::uint8_t temperature = 0;
    friend bool operator==(const Sample&, const Sample&) = default;
  };
  static constexpr std::size_t kMaxSamples = (kMaxDataSize - 2) / 3;
  std::uint8_t count = 0;
  std::array<Sample, kMaxSamples> samples{};
  std::span<const Sample> all() const { return {samples.data(), count}; }
  friend bool operator==(const GyroPacket&, const GyroPacket&) = default;
};
inline constexpr double kGyroSamplePeriod_s = 0.025;

/// None when `data` is another packet or truncated. A truncated GYROpac gives its complete samples.
std::optional<EncoderPacket> decode_encoder(ByteView data);
std::optional<GyroPacket> decode_gyro(ByteView data);

Frame encode_encoder(const EncoderPacket& encoder);
Frame encode_gyro(const GyroPacket& gyro);

/// A packet with its decoded motion data. It is decoded once for session, odometer and driver. Borrows as a Packet
/// does.
struct Message {
  Packet packet;
  /// Empty for a packet of another kind, or a truncated one.
  std::variant<std::monostate, StandardSip, EncoderPacket, GyroPacket> motion;

  std::uint8_t id() const { return packet.id(); }
  const StandardSip* sip() const { return std::get_if<StandardSip>(&motion); }
};

/// Thread contract: reentrant; never allocates.
Message decoded(const Packet& packet);

}  // namespace azimuth::pioneer
