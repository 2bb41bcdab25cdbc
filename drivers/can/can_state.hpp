#pragma once
#include <cstdint>
#include <limits>

#include "drivers/can/can_bus.hpp"
#include "drivers/device/connection.hpp"

namespace azimuth {

/// The state of the base and of its bus. While the base is away, the members hold its last values.
struct CanState : DeviceState {
  CanBusState bus = CanBusState::active;

  double battery_V = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not reported
  bool emergency_stop = false, bumper = false, charging = false;
  double speed_m_s = 0.0;

  std::uint64_t frames = 0;   ///< frames that are read
  std::uint64_t foreign = 0;  ///< other frames that passed the filter
  /// Invalid frames, and frames that are too short for their signals or hold a float that is not a number.
  std::uint64_t malformed = 0;
  std::uint64_t error_frames = 0;      ///< error frames of the controller
  std::uint64_t bus_offs = 0;          ///< how often the controller left the bus
  std::uint64_t dropped = 0;           ///< frames dropped by the kernel or the controller because buffers were full
  std::uint64_t missed = 0;            ///< odometry values that were due and did not arrive
  std::uint64_t doubted = 0;           ///< implausible odometry values
  std::uint64_t restarts = 0;          ///< how often the base restarted its counting
  std::uint64_t gaps = 0;              ///< readings with more than the usual uncertainty
  std::uint64_t stale = 0;             ///< how often odometry stopped arriving
  std::uint64_t stamps_replaced = 0;   ///< implausible receive stamps
  std::uint64_t refused_readings = 0;  ///< readings not taken in time
  /// How often odometry arrived from an interface that was just opened or brought up.
  std::uint64_t sessions = 0;
  std::uint64_t reconnects() const { return sessions > 0 ? sessions - 1 : 0; }
};

}  // namespace azimuth
