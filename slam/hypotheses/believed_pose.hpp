#pragma once
#include <Eigen/Core>
#include <span>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Estimated pose of the robot.
struct BelievedPose {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, heading), in the map
};

/// Difference `to` - `from` in (x, y, heading), with the heading wrapped.
Eigen::Vector3d pose_difference(const Pose2& from, const Pose2& to);

/// Mean and covariance of a mixture of beliefs, whose weights sum to one. The covariance contains each belief's own
/// covariance and the spread of the means. Headings are averaged relative to `centre`, one of the poses. Thread
/// contract: reentrant.
BelievedPose mixture(std::span<const BelievedPose> beliefs, std::span<const double> weights, const Pose2& centre);

/// Combines two answers: `first` is wrong with probability `first_wrong`, and then `second` is right. The returned pose
/// lies `share` of the way from `first` to `second`; the covariance is that of the mixture about this pose. Thread
/// contract: reentrant.
BelievedPose one_of_two(const BelievedPose& first, const BelievedPose& second, double first_wrong, double share);

}  // namespace azimuth
