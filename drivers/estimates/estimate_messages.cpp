#include "drivers/estimates/estimate_messages.hpp"

#include "slam/sample/stamp.hpp"

namespace azimuth {

std::int8_t health_code(Health health) {
  switch (health) {
    case Health::starting:
      return pose_cov_t::HEALTH_STARTING;
    case Health::tracking:
      return pose_cov_t::HEALTH_TRACKING;
    case Health::degraded:
      return pose_cov_t::HEALTH_DEGRADED;
    case Health::lost:
      break;
  }
  return pose_cov_t::HEALTH_LOST;
}

std::optional<Health> health_of(std::int8_t code) {
  for (const Health health : {Health::starting, Health::tracking, Health::degraded, Health::lost})
    if (health_code(health) == code) return health;
  return std::nullopt;
}

pose_cov_t to_message(const Estimate& estimate) {
  pose_cov_t message;
  message.utime = to_us(estimate.stamp);
  message.utime_mono = 0;
  message.seq = static_cast<std::int64_t>(estimate.sequence);  // LCM has no unsigned integer types
  message.x_m = estimate.T_map_body.x_m;
  message.y_m = estimate.T_map_body.y_m;
  message.heading_rad = estimate.T_map_body.heading_rad;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      message.covariance[3 * row + column] = estimate.pose_covariance(row, column);
  message.odom_x_m = estimate.T_odom_body.x_m;
  message.odom_y_m = estimate.T_odom_body.y_m;
  message.odom_heading_rad = estimate.T_odom_body.heading_rad;
  message.health = health_code(estimate.health);
  message.predicted = estimate.predicted ? 1 : 0;
  message.step = static_cast<std::int64_t>(estimate.step);
  return message;
}

Pose2 map_pose_of(const pose_cov_t& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }

Pose2 odom_pose_of(const pose_cov_t& pose) { return {pose.odom_x_m, pose.odom_y_m, pose.odom_heading_rad}; }

Eigen::Matrix3d covariance_of(const pose_cov_t& pose) {
  Eigen::Matrix3d P;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) P(row, column) = pose.covariance[3 * row + column];
  return P;
}

landmark_t to_message(const LandmarkEstimate& landmark) {
  const Eigen::Matrix2d& covariance = landmark.covariance_m2;
  landmark_t message;
  message.id = landmark.id;
  message.identity = landmark.identity;
  message.x_m = landmark.p_map_landmark_m.x();
  message.y_m = landmark.p_map_landmark_m.y();
  message.z_m = landmark.z_map_landmark_m;
  message.covariance[0] = covariance(0, 0);
  message.covariance[1] = covariance(0, 1);
  message.covariance[2] = covariance(1, 1);
  message.sigma_z_m = landmark.sigma_z_m;
  return message;
}

LandmarkEstimate landmark_of(const landmark_t& message) {
  LandmarkEstimate landmark;
  landmark.id = message.id;
  landmark.identity = message.identity;
  landmark.p_map_landmark_m = {message.x_m, message.y_m};
  landmark.covariance_m2 << message.covariance[0], message.covariance[1], message.covariance[1], message.covariance[2];
  landmark.z_map_landmark_m = message.z_m;
  landmark.sigma_z_m = message.sigma_z_m;
  return landmark;
}

path_pose_t to_message(const PathPose& pose) {
  path_pose_t message;
  message.utime = to_us(pose.stamp);
  message.x_m = pose.T_map_body.x_m;
  message.y_m = pose.T_map_body.y_m;
  message.heading_rad = pose.T_map_body.heading_rad;
  return message;
}

PathPose path_pose_of(const path_pose_t& message) {
  return {stamp_from_us(message.utime), {message.x_m, message.y_m, message.heading_rad}};
}

}  // namespace azimuth
