#pragma once
#include <string>
#include <vector>

#include "drivers/can/can_signal.hpp"

namespace azimuth {

/// What the base sends of its motion.
enum class CanOdometryKind {
  ticks,   ///< a counter of each wheel's way, which may wrap
  speeds,  ///< of each wheel; integrated here
  pose     ///< x, y and heading, integrated by the base
};

/// Of a wheel's speed.
enum class CanSpeedUnit { m_per_s, rpm, rad_per_s };

/// A signal described in the configuration, for a base that has no DBC file.
struct CanSignalSettings {
  std::string name{};     ///< by which other settings call it
  int id = 0;             ///< of its frame
  bool extended = false;  ///< the id has 29 bits
  int start_bit = 0;
  int length_bits = 16;
  CanByteOrder byte_order = CanByteOrder::intel;
  CanNumber number = CanNumber::signed_integer;
  double scale = 1.0;
  double offset = 0.0;
  std::string multiplexer{};  ///< name of the signal that must have `multiplexer_value`; empty: none
  int multiplexer_value = 0;
};

/// A signal that says yes or no.
struct CanFlagSettings {
  std::string signal{};  ///< empty: the base does not say
  int mask = -1;         ///< the bits that count; -1: all
  int value = -1;        ///< of those bits when it is yes; -1: any but zero
};

/// How a base on a CAN bus is reached and read. Signals are named "Message.Signal", of the DBC file, or as in
/// `signals`.
struct CanSettings {
  std::string interface = "can0";
  std::string dbc;  ///< file; empty: none
  CanOdometryKind odometry = CanOdometryKind::ticks;

  std::string left, right;  ///< ticks or speeds
  bool left_reversed = false, right_reversed = false;
  double ticks_per_m = 0.0;  ///< units of the signals per metre of a wheel's way
  CanSpeedUnit speed_unit = CanSpeedUnit::m_per_s;
  double wheel_radius_m = 0.0;  ///< for speeds of rotation
  double track_m = 0.0;         ///< between the wheels

  std::string x, y, heading;  ///< pose
  double position_scale_m = 1.0;
  double heading_scale_rad = 1.0;

  std::string battery;  ///< volts; empty: the base does not say
  CanFlagSettings emergency_stop, bumper, charging;

  double latency_s = 0.0;       ///< from the base's look at its wheels to the frame's arrival
  double stale_s = 0.5;         ///< without odometry for so long: state `stale`
  double max_speed_m_s = 2.2;   ///< fastest the robot can be; faster steps are not trusted
  double max_turn_rad_s = 6.3;  ///< likewise turning

  std::vector<CanSignalSettings> signals;
};

}  // namespace azimuth
