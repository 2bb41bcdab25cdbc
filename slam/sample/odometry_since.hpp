#pragma once
#include <optional>

#include "slam/geometry/motion.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// How a robot got from where its map was saved to an odometry reading. With it an estimator that starts from that map
/// knows where the robot is, provided that the odometer has counted on.
struct OdometrySince {
  Stamp map{};              ///< of the saved map: the motion leads from the robot's pose there
  Motion motion;            ///< to `reading`, calibrated
  OdometryReading reading;  ///< as the odometer said it
  Pose2 T_odom_body;        ///< then, calibrated: as it was published
};

/// How the robot went since the map that the next start would begin from, and since one that is to take its place but
/// may not come to the disk. Nothing: it does not tell where the robot is, or there is no such map.
struct OdometryWays {
  std::optional<OdometrySince> since_map, since_made_map;
};

}  // namespace azimuth
