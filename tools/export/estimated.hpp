#pragma once
// What every export is made of.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/past_pose.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Where the robot was at an instant. What nobody knows is left out.
struct EstimatedPose {
  Stamp stamp{};
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
  std::optional<Pose2> T_odom_body;                      ///< calibrated odometry at the same instant
  std::optional<Health> health;
  std::string reason;  ///< of the health; may be empty
};

/// What was estimated of a run, by whoever did.
struct Estimated {
  std::string run;                   ///< its name
  std::vector<EstimatedPose> poses;  ///< at least one; stamps strictly increase
  /// Where the robot has been, as it was known at the end; empty: where `poses` say.
  std::vector<PathPose> path;
  std::vector<LandmarkEstimate> landmarks;  ///< the map at the end
};

/// The whole of a file, or one sentence on why there can be none.
using Exported = tl::expected<std::string, std::string>;

/// The path as it is known at the end.
inline std::vector<PathPose> path_of(const Estimated& estimated) {
  if (!estimated.path.empty()) return estimated.path;
  std::vector<PathPose> path;
  for (const EstimatedPose& pose : estimated.poses) path.push_back({pose.stamp, pose.T_map_body});
  return path;
}

}  // namespace azimuth
