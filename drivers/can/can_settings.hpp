#pragma once
#include <string>
#include <vector>

#include "drivers/can/can_signal.hpp"

namespace azimuth {

/// The kind of motion data that the base sends.
enum class CanOdometryKind {
  ticks,   ///< a counter of each wheel's travel, which may wrap
  speeds,  ///< the speed of each wheel; integrated by CanOdometer
  pose     ///< x, y and heading, integrated by the base
};

/// The unit of wheel speeds.
enum class CanSpeedUnit { m_per_s, rpm, rad_per_s };

/// A signal described in the configuration, for a base that has no DBC file.
struct CanSignalSettings {
  std::string name{};     ///< name by which other settings refer to it
  int id = 0;             ///< identifier of the frame that holds the signal
  bool extended = false;  ///< the identifier has 29 bits
  int start_bit = 0;
  int length_bits = 16;
  CanByteOrder byte_order = CanByteOrder::intel;
  CanNumber number = CanNumber::signed_integer;
  double scale = 1.0;
  double offset = 0.0;
  std::string multiplexer{};  ///< name of the signal that must equal `multiplexer_value`; empty: none
  int multiplexer_value = 0;
};

/// The bus of a base and its signals. Signals are named "Message.Signal" as in the DBC file, or as in `signals`.
struct CanSettings {
  std::string interface = "can0";
  std::string dbc;  ///< path of the DBC file; empty: none
  CanOdometryKind odometry = CanOdometryKind::ticks;

  std::string left, right;  ///< signals of ticks or speeds
  bool left_reversed = false, right_reversed = false;
  double ticks_per_m = 0.0;  ///< units of the signals per metre of wheel travel
  CanSpeedUnit speed_unit = CanSpeedUnit::m_per_s;
  double wheel_radius_m = 0.0;  ///< used for rotational speeds
  double track_m = 0.0;         ///< distance between the wheels

  std::string x, y, heading;  ///< signals of the pose
  double position_scale_m = 1.0;
  double heading_scale_rad = 1.0;

  std::string battery;                           ///< signal of the voltage; empty: the base does not have it
  std::string emergency_stop, bumper, charging;  ///< yes: the signal is not 0; empty: the base does not have it

  double latency_s = 0.0;       ///< from the measurement in the base to the arrival of its frame
  double stale_s = 0.5;         ///< without odometry for this long the connection counts as silent
  double max_speed_m_s = 2.2;   ///< largest speed of the robot; faster steps are not trusted
  double max_turn_rad_s = 6.3;  ///< largest turn rate of the robot; faster turns are not trusted

  std::vector<CanSignalSettings> signals;
};

}  // namespace azimuth
