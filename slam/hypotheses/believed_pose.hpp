#pragma once
#include <Eigen/Core>
#include <span>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Where the robot is thought to be.
struct BelievedPose {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, heading), in the map
};

/// By how much (x, y, heading) of `to` are more than those of `from`, the heading the shorter way round.
Eigen::Vector3d pose_difference(const Pose2& from, const Pose2& to);

/// Mean and covariance of several beliefs, whose weights sum to one: what each says of itself, and how far they are
/// apart. Headings are averaged as seen from `centre`, one of them. Thread contract: reentrant.
BelievedPose mixture(std::span<const BelievedPose> beliefs, std::span<const double> weights, const Pose2& centre);

/// Of two answers, the first of which is wrong with this probability, and then the second is right: told as the pose
/// that is `share` of the way from one to the other, and how far off that is. Thread contract: reentrant.
BelievedPose one_of_two(const BelievedPose& first, const BelievedPose& second, double first_wrong, double share);

}  // namespace azimuth
