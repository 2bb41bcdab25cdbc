#pragma once
// Messages of ROS from what was estimated. Reentrant.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ros/messages.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/past_pose.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::ros {

/// The names of the frames, as ROS's REP 105 has them.
struct Frames {
  std::string map = "map";         ///< landmarks lie in it; the robot's pose may jump
  std::string odom = "odom";       ///< drifts, never jumps
  std::string base = "base_link";  ///< the robot: x ahead, y to the left, z up
};

Pose to_pose(const Pose2& pose, double z_m = 0.0);

PoseWithCovarianceStamped pose_message(const Frames& frames, Stamp stamp, const Pose2& T_map_body,
                                       const Eigen::Matrix3d& covariance);

/// Where the robot was, and when.
struct TimedPose {
  Stamp stamp{};
  Pose2 pose;
};

/// The robot's velocity on its way from `before` to `after`, in its own frame; zero when these are more than a second
/// apart, or not in this order: nobody knows then.
Twist velocity_between(const TimedPose& before, const TimedPose& after);

/// Of calibrated odometry. How well it is known is not: the covariances are zero.
Odometry odometry_message(const Frames& frames, const std::optional<TimedPose>& before, const TimedPose& now);

/// From the map to the odometer's frame; and from there to the robot if `with_base`.
TransformMessage transform_message(const Frames& frames, Stamp stamp, const Pose2& T_map_body, const Pose2& T_odom_body,
                                   bool with_base);

Path path_message(const Frames& frames, Stamp stamp, std::span<const PathPose> path);

/// A sphere for each landmark ("landmarks"), a flat ellipse of two standard deviations ("uncertainty") and its name
/// ("names"): the identity that the sensor gave it, else `#` and its id. Whatever was drawn before goes.
MarkerArray landmark_markers(const Frames& frames, Stamp stamp, std::span<const LandmarkEstimate> landmarks);

/// How far the pose can be relied on: tracking is OK, starting and degraded are WARN, lost is ERROR.
DiagnosticStatus health_status(Health health, std::string_view reason);

}  // namespace azimuth::ros
