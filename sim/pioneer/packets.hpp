#pragma once
// What the simulated controller sends, written field by field. Apart from the framing it shares no code with the
// driver that reads it: a mistake in one of the two must not hide in the other.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/pioneer/packet.hpp"
#include "sim/pioneer/model.hpp"

namespace azimuth::sim {

using Bytes = std::vector<std::uint8_t>;

struct SonarReading {
  std::uint8_t index = 0;
  std::uint16_t range_mm = 0;
};

/// A standard SIP in the robot's own units.
struct SipFields {
  std::uint8_t id = 0x32;
  std::uint16_t x = 0, y = 0;  ///< already wrapped
  std::int16_t heading = 0;    ///< kHeadingCounts a turn
  std::int16_t left_velocity = 0, right_velocity = 0;
  double battery_v = 0.0;
  std::uint8_t left_stall_bumpers = 0;   ///< bit 0 wheel stall, bits 1 to 7 rear bumpers
  std::uint8_t right_stall_bumpers = 0;  ///< bit 0 wheel stall, bits 1 to 7 front bumpers
  std::int16_t control = 0;              ///< heading set-point
  std::uint16_t flags = 0;
  std::span<const SonarReading> sonar;
  std::uint8_t analog_port = 0;  ///< the one the client selected
  std::uint8_t digital_out = 0;
  std::int16_t rotation_velocity_ddeg_per_s = 0;
};

/// What is connected to the controller apart from wheels and sonar. Analog inputs there are, but nothing on them.
struct IoFields {
  std::uint8_t digital_in = 0;
  std::uint8_t front_bumpers = 0, rear_bumpers = 0;  ///< a bit each, from bit 0
  std::uint8_t digital_out = 0;
};

struct GyroSample {
  std::uint16_t rate = 512;  ///< 0 to 1023; above the centre: clockwise
  std::uint8_t temperature = 0;
};

pioneer::Frame sip_packet(const SipFields& fields);
/// SYNC2's answer: robot name, class and subclass.
pioneer::Frame names_packet(const PioneerModel& model);
/// `limits`: the present ones.
pioneer::Frame config_packet(const PioneerModel& model, const MotionLimits& limits, int host_baud_code);
pioneer::Frame encoder_packet(std::int32_t left_ticks, std::int32_t right_ticks);
pioneer::Frame io_packet(const IoFields& fields);
pioneer::Frame gyro_packet(std::span<const GyroSample> samples);
/// An answer that is nothing but its id, as the echoes of SYNC0 and SYNC1 are.
pioneer::Frame bare_packet(std::uint8_t id);

}  // namespace azimuth::sim
