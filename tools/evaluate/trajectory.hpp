#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

struct StampedPose {
  Stamp stamp{};
  Pose2 pose;  ///< pose of the body; the holder of the struct states the frame
};

/// The values of one estimate that the evaluation needs.
struct EstimateRecord {
  Stamp stamp{};
  Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad]) in the map frame
  Pose2 T_odom_body;                                     ///< calibrated odometry at the same instant
};

/// Largest gap in the truth that interpolation bridges. The truth has longer gaps when the robot leaves the view of the
/// cameras that record it.
inline constexpr double kMaxTruthGap_s = 1.0;

/// The pose at `stamp`: a sample with that stamp, or the interpolation between its two neighbours if they are at most
/// `max_gap_s` apart. Otherwise nothing. `trajectory` is sorted by stamp.
std::optional<Pose2> pose_at(std::span<const StampedPose> trajectory, Stamp stamp, double max_gap_s = kMaxTruthGap_s);

}  // namespace azimuth
