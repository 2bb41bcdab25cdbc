#pragma once
#include <cstdint>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// One reading of the wheel odometry: the cumulative pose since the odometer started, not an increment, so that a
/// lost reading loses no motion.
struct OdometryReading {
  Stamp stamp{};
  std::uint64_t sequence = 0;  ///< counts readings at their source; a gap means readings were lost
  std::uint32_t origin = 0;    ///< changes whenever the odometer restarted: poses of two origins are not comparable
  Pose2 T_odom_body;
  // What the odometer itself does not trust of the motion since its last reading (readings lost, a step too large to be
  // true, a session that had to be opened anew), beyond the noise wheels always have. Standard deviations.
  double sigma_gap_m = 0.0;  ///< along each axis
  double sigma_gap_rad = 0.0;
  friend bool operator==(const OdometryReading&, const OdometryReading&) = default;
};

}  // namespace azimuth
