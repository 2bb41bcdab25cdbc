#pragma once
// The packets that the simulated controller sends, written field by field. Apart from the framing, no code is shared
// with the driver that reads them, so that an error in one of the two cannot hide in the other.

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

/// The fields of a standard SIP in the robot's own units.
struct SipFields {
  std::uint8_t id = 0x32;
  std::uint16_t x = 0, y = 0;  ///< Position counters, already wrapped
  std::int16_t heading = 0;    ///< In counts; a turn has kHeadingCounts
  std::int16_t left_velocity = 0, right_velocity = 0;
  double battery_v = 0.0;
  std::uint8_t left_stall_bumpers = 0;   ///< Bit 0: wheel stall, bits 1 to 7: rear bumpers
  std::uint8_t right_stall_bumpers = 0;  ///< Bit 0: wheel stall, bits 1 to 7: front bumpers
  std::int16_t control = 0;              ///< Heading set-point
  std::uint16_t flags = 0;
  std::span<const SonarReading> sonar;
  std::uint8_t analog_port = 0;  ///< The port that the client selected
  std::uint8_t digital_out = 0;
  std::int16_t rotation_velocity_ddeg_per_s = 0;
};

/// Inputs and outputs of the controller besides wheels and sonar. Nothing is connected to the analogue inputs.
struct IoFields {
  std::uint8_t digital_in = 0;
  std::uint8_t front_bumpers = 0, rear_bumpers = 0;  ///< One bit for each bumper, from bit 0
  std::uint8_t digital_out = 0;
};

struct GyroSample {
  std::uint16_t rate = 512;  ///< 0 to 1023; above the centre: clockwise
  std::uint8_t temperature = 0;
};

pioneer::Frame sip_packet(const SipFields& fields);
/// The answer to SYNC2: robot name, class and subclass.
pioneer::Frame names_packet(const PioneerModel& model);
/// CONFIGpac. `limits`: the current limits of the motion.
pioneer::Frame config_packet(const PioneerModel& model, const MotionLimits& limits, int host_baud_code);
pioneer::Frame encoder_packet(std::int32_t left_ticks, std::int32_t right_ticks);
pioneer::Frame io_packet(const IoFields& fields);
pioneer::Frame gyro_packet(std::span<const GyroSample> samples);
/// A packet that consists only of its id, like the echoes of SYNC0 and SYNC1.
pioneer::Frame bare_packet(std::uint8_t id);

}  // namespace azimuth::sim
