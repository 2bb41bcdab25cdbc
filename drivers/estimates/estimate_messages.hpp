#pragma once
// Estimates as LCM messages, and back; samples are in drivers/wire/messages.hpp. Thread contract: reentrant.

#include <Eigen/Core>
#include <azimuth/landmark_t.hpp>
#include <azimuth/path_pose_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <optional>

#include "slam/estimator/estimate.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// The code of a health in pose_cov_t.
std::int8_t health_code(Health health);
/// The health of a code; none for a code of another version.
std::optional<Health> health_of(std::int8_t code);

/// The message of an estimate. The caller fills in the sending time.
pose_cov_t to_message(const Estimate& estimate);
Pose2 map_pose_of(const pose_cov_t& pose);
Pose2 odom_pose_of(const pose_cov_t& pose);
/// Covariance of (x [m], y [m], heading [rad]) in the map frame.
Eigen::Matrix3d covariance_of(const pose_cov_t& pose);

/// For a landmark mapped in the plane, height and its standard deviation are NaN.
landmark_t to_message(const LandmarkEstimate& landmark);
LandmarkEstimate landmark_of(const landmark_t& message);

path_pose_t to_message(const PathPose& pose);
PathPose path_pose_of(const path_pose_t& message);

}  // namespace azimuth
