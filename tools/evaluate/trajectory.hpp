#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

struct StampedPose {
  Stamp stamp{};
  Pose2 pose;  ///< of the body, in a frame that the holder names
};

/// What evaluation needs of one estimate.
struct EstimateRecord {
  Stamp stamp{};
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
  Pose2 T_odom_body;                                     ///< calibrated odometry at the same instant
};

/// Truth with holes in it (the robot out of the cameras' sight) is not bridged by a straight line.
inline constexpr double kMaxTruthGap_s = 1.0;

/// The pose at `stamp`: a sample taken then, or interpolated between its two neighbours if these are at most
/// `max_gap_s` apart. `trajectory` is sorted by stamp.
std::optional<Pose2> pose_at(std::span<const StampedPose> trajectory, Stamp stamp, double max_gap_s = kMaxTruthGap_s);

}  // namespace azimuth
