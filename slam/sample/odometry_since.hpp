#pragma once
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

}  // namespace azimuth
