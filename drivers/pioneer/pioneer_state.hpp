#pragma once
#include <cstdint>
#include <string>

#include "drivers/device/connection.hpp"

namespace azimuth {

/// The state of the robot and of the line to it. While the robot is away, the members hold its last values.
struct PioneerState : DeviceState {
  std::string name, subclass, firmware;  ///< as the robot reports
  int baud = 0;                          ///< 0: not a serial line, or not known yet
  bool config_unverified = false;        ///< the robot's CONFIGpac had a wrong checksum and was accepted
  bool uses_ticks = false, uses_gyro = false;

  double battery_V = 0.0;
  struct Charge {
    int percent = -1;  ///< -1: not reported
    /// 0 not charging, 1 bulk, 2 overcharge, 3 float, 4 balance, 255 not reported.
    int state = 255;
  };
  Charge charge;
  bool left_stall = false, right_stall = false;
  struct Bumpers {
    std::uint8_t front = 0, rear = 0;  ///< one bit for each, from bit 0
  };
  Bumpers bumpers;
  bool motors_enabled = false, emergency_stop = false;
  double speed_m_s = 0.0;

  std::uint64_t packets = 0;        ///< correct packets
  std::uint64_t bad_checksums = 0;  ///< wrong checksums, including that of an accepted CONFIGpac
  /// Bytes that belong to no packet, while odometry arrived.
  std::uint64_t skipped_bytes = 0;
  std::uint64_t sessions = 0;          ///< sessions opened so far; all but the first are reconnects or reboots
  std::uint64_t resumed = 0;           ///< how often a session continued after its line had been broken
  std::uint64_t reboots = 0;           ///< reboots of the controller
  std::uint64_t gaps = 0;              ///< readings with more than the usual uncertainty
  std::uint64_t stale = 0;             ///< how often odometry stopped arriving
  std::uint64_t refused_readings = 0;  ///< readings not taken in time
  std::uint64_t reconnects() const { return resumed + (sessions > 0 ? sessions - 1 : 0); }
};

}  // namespace azimuth
