#pragma once
#include <cstdint>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// One reading of the wheel odometry. The pose is cumulative since the odometer started, so a lost reading loses no
/// motion.
struct OdometryReading {
  Stamp stamp{};
  std::uint64_t sequence = 0;  ///< counts readings at their source; a gap means readings were lost
  std::uint32_t origin = 0;    ///< changes when the odometer restarts; poses of different origins are not comparable
  Pose2 T_odom_body;
  // Additional standard deviations of the motion since the last reading, beyond the usual noise of wheels. The odometer
  // sets them after lost readings, an implausibly large step, or a new session.
  double sigma_gap_m = 0.0;  ///< along each axis
  double sigma_gap_rad = 0.0;
  friend bool operator==(const OdometryReading&, const OdometryReading&) = default;
};

}  // namespace azimuth
