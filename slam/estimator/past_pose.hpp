#pragma once
#include <Eigen/Core>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Where the robot was at an instant of the past, by all that was seen until now.
struct PastPose {
  Stamp stamp{};
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
};

/// Likewise without how well that is known.
struct PathPose {
  Stamp stamp{};
  Pose2 T_map_body;
};

}  // namespace azimuth
