#pragma once
#include <optional>

#include "slam/geometry/motion.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

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
