#pragma once
// The input of all exports.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The estimate at one instant. Unknown values are empty.
struct EstimatedPose {
  Stamp stamp{};
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
  std::optional<Pose2> T_odom_body;                      ///< calibrated odometry at the same instant
  std::optional<Health> health;
  std::string reason;  ///< reason of the health; may be empty
};

/// The estimates of a run, from a replay or a recording.
struct Estimated {
  std::string run;                   ///< name of the run
  std::vector<EstimatedPose> poses;  ///< at least one; stamps strictly increase
  /// The smoothed path as known at the end; if empty, the path consists of `poses`.
  std::vector<PathPose> path;
  std::vector<LandmarkEstimate> landmarks;  ///< the final map
};

struct RecordedOutputs;

/// The estimates that a daemon published.
Estimated estimated_of(const RecordedOutputs& outputs, std::string run);

/// The content of a file, or a sentence with the reason why it cannot be made.
using Exported = tl::expected<std::string, std::string>;

/// The smoothed path, or the poses if there is none.
inline std::vector<PathPose> path_of(const Estimated& estimated) {
  if (!estimated.path.empty()) return estimated.path;
  std::vector<PathPose> path;
  for (const EstimatedPose& pose : estimated.poses) path.push_back({pose.stamp, pose.T_map_body});
  return path;
}

}  // namespace azimuth
