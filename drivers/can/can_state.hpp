#pragma once
#include <cstdint>
#include <limits>

#include "drivers/can/can_bus.hpp"
#include "drivers/device/connection.hpp"

namespace azimuth {

/// What is known of the base and of the bus to it. Of a base that is away, what it said last.
struct CanState : DeviceState {
  CanBusState bus = CanBusState::active;

  double battery_V = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not said
  bool emergency_stop = false, bumper = false, charging = false;
  double speed_m_s = 0.0;

  std::uint64_t frames = 0;            ///< wanted ones
  std::uint64_t foreign = 0;           ///< others that came through the filter
  std::uint64_t malformed = 0;         ///< no frames, or too short for their signals, or with a float that is no number
  std::uint64_t error_frames = 0;      ///< of the controller
  std::uint64_t bus_offs = 0;          ///< times the controller left the bus
  std::uint64_t dropped = 0;           ///< frames, by the kernel or the controller, for want of room
  std::uint64_t missed = 0;            ///< values of the odometry that were due and did not come
  std::uint64_t doubted = 0;           ///< and that could not be true
  std::uint64_t restarts = 0;          ///< times the base began to count anew
  std::uint64_t gaps = 0;              ///< readings with more than the usual uncertainty
  std::uint64_t stale = 0;             ///< times odometry stopped coming
  std::uint64_t stamps_replaced = 0;   ///< receive stamps that could not be true
  std::uint64_t refused_readings = 0;  ///< not taken in time
  std::uint64_t sessions = 0;          ///< times odometry came from an interface newly opened or switched on
  std::uint64_t reconnects() const { return sessions > 0 ? sessions - 1 : 0; }
};

}  // namespace azimuth
