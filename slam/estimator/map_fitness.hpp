#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocaliser.hpp"

namespace azimuth {

/// Which part of the system names landmarks on this rig.
MapNames names_of(const Rig& rig);

/// Why this rig cannot tell apart the landmarks of `map`, given how they are named. Nothing when it can.
std::optional<std::string_view> why_names_do_not_fit(const MapSnapshot& map, const Rig& rig);

/// Error text: a map of indistinguishable landmarks cannot be used to find an unknown start pose.
inline constexpr std::string_view kPoseIsNeeded =
    "landmarks without names or looks do not tell a robot where it is: say map.pose_known = true when it knows";

/// What is known of the start pose when odometry does not continue from the saved pose.
struct StartPose {
  bool known = false;  ///< The robot is near the pose at which the map was saved
  /// Covariance of (x [m], y [m], heading [rad]) of the robot's displacement since the map was saved.
  Eigen::Matrix3d moved = Eigen::Matrix3d::Zero();
  std::optional<PositionPrior> within;  ///< Search area if the pose is not known; nothing: anywhere
};
StartPose start_pose(const MapStart& start);

}  // namespace azimuth
