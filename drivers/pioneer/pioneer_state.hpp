#pragma once
#include <cstdint>
#include <string>

#include "drivers/device/connection.hpp"

namespace azimuth {

/// What is known of the robot and of the line to it. Of a robot that is away, what it said last.
struct PioneerState : DeviceState {
  std::string name, subclass, firmware;  ///< as the robot says
  int baud = 0;                          ///< 0: not a serial line, or not known yet
  bool config_unverified = false;        ///< its CONFIGpac came with a wrong checksum and was believed
  bool uses_ticks = false, uses_gyro = false;

  double battery_V = 0.0;
  struct Charge {
    int percent = -1;  ///< -1: not said
    int state = 255;   ///< 0 not charging, 1 bulk, 2 overcharge, 3 float, 4 balance, 255 not said
  };
  Charge charge;
  bool left_stall = false, right_stall = false;
  struct Bumpers {
    std::uint8_t front = 0, rear = 0;  ///< one bit each, from bit 0
  };
  Bumpers bumpers;
  bool motors_enabled = false, emergency_stop = false;
  double speed_m_s = 0.0;

  std::uint64_t packets = 0;           ///< good ones
  std::uint64_t bad_checksums = 0;     ///< also of a believed CONFIGpac
  std::uint64_t skipped_bytes = 0;     ///< that belonged to no packet, while odometry came
  std::uint64_t sessions = 0;          ///< opened so far; all but the first are reconnects or reboots
  std::uint64_t resumed = 0;           ///< times a session went on after its line had been broken
  std::uint64_t reboots = 0;           ///< of the controller
  std::uint64_t gaps = 0;              ///< readings with more than the usual uncertainty
  std::uint64_t stale = 0;             ///< times odometry stopped coming
  std::uint64_t refused_readings = 0;  ///< not taken in time
  std::uint64_t reconnects() const { return resumed + (sessions > 0 ? sessions - 1 : 0); }
};

}  // namespace azimuth
