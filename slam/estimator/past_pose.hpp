#pragma once
#include <Eigen/Core>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The robot's pose at a past instant, by everything that was seen until now.
struct PastPose {
  Stamp stamp{};
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
};

/// A past pose without its covariance.
struct PathPose {
  Stamp stamp{};
  Pose2 T_map_body;
};

}  // namespace azimuth
