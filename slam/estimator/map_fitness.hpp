#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocaliser.hpp"

namespace azimuth {

/// Who names landmarks on this rig.
MapNames names_of(const Rig& rig);

/// Why landmarks named as in `map` cannot be told apart on this rig; nothing: they can.
std::optional<std::string_view> why_names_do_not_fit(const MapSnapshot& map, const Rig& rig);

/// Why a map of landmarks all alike cannot be started from.
inline constexpr std::string_view kPoseIsNeeded =
    "landmarks without names or looks do not tell a robot where it is: say map.pose_known = true when it knows";

/// What is known of a robot's pose whose odometry does not go on.
struct StartPose {
  bool known = false;  ///< about where the map was saved
  /// How far it may have been moved since: covariance of (x [m], y [m], heading [rad]).
  Eigen::Matrix3d moved = Eigen::Matrix3d::Zero();
  std::optional<Whereabouts> within;  ///< where to look for it if it is not; nothing: anywhere
};
StartPose start_pose(const MapStart& start);

}  // namespace azimuth
