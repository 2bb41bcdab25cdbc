#pragma once
#include <cstdint>
#include <optional>

#include "slam/geometry/motion.hpp"
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

/// The motion of a robot from the pose where its map was saved to an odometry reading. An estimator that starts from
/// that map can compute the robot's pose with it, provided that the odometer has not restarted.
struct OdometrySince {
  Stamp map{};              ///< stamp of the saved map, at whose pose the motion starts
  Motion motion;            ///< calibrated motion to `reading`
  OdometryReading reading;  ///< uncalibrated
  Pose2 T_odom_body;        ///< calibrated pose at `reading`, as published
};

/// The motions since the map on disk, and since a newer map that may not have been written to disk yet. Empty: there is
/// no such map, or it does not determine the robot's pose.
struct OdometryWays {
  std::optional<OdometrySince> since_map, since_made_map;
};

}  // namespace azimuth
