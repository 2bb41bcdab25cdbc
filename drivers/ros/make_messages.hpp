#pragma once
// Makes ROS messages from estimates. Thread contract: reentrant.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drivers/ros/messages.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::ros {

/// The names of the frames according to ROS's REP 105.
struct Frames {
  std::string map = "map";         ///< frame of the landmarks; the robot's pose in it may jump
  std::string odom = "odom";       ///< frame of the odometry; the robot's pose in it drifts, but never jumps
  std::string base = "base_link";  ///< the robot: x forward, y to the left, z up
};

Pose to_pose(const Pose2& pose, double z_m = 0.0);

PoseWithCovarianceStamped pose_message(const Frames& frames, Stamp stamp, const Pose2& T_map_body,
                                       const Eigen::Matrix3d& covariance);

/// A pose of the robot and its time.
struct TimedPose {
  Stamp stamp{};
  Pose2 pose;
};

/// The velocity of the robot between `before` and `after`, in its own frame. Zero when the times are more than a second
/// apart or not in this order, because the velocity is then unknown.
Twist velocity_between(const TimedPose& before, const TimedPose& after);

/// The message of calibrated odometry. The uncertainty of odometry is unknown, so the covariances are zero.
Odometry odometry_message(const Frames& frames, const std::optional<TimedPose>& before, const TimedPose& now);

/// The transform from the map to the odometer's frame, and from there to the robot if `with_base`.
TransformMessage transform_message(const Frames& frames, Stamp stamp, const Pose2& T_map_body, const Pose2& T_odom_body,
                                   bool with_base);

Path path_message(const Frames& frames, Stamp stamp, std::span<const PathPose> path);

/// For each landmark a sphere ("landmarks"), a flat ellipse of two standard deviations ("uncertainty") and its name
/// ("names"): the sensor's identity, or `#` and the landmark's id. All earlier markers are deleted.
MarkerArray landmark_markers(const Frames& frames, Stamp stamp, std::span<const LandmarkEstimate> landmarks);

/// How reliable the pose is: tracking is OK, starting and degraded are WARN, lost is ERROR.
DiagnosticStatus health_status(Health health, std::string_view reason);

}  // namespace azimuth::ros
