#include "slam/geometry/motion.hpp"

#include <cmath>

#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

constexpr double kTurnOnTheSpotBelow_m = 1e-4;

Eigen::Matrix3d rotation_of_pose(double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  Eigen::Matrix3d R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

}  // namespace

Control control_between(const Pose2& T_odom_start, const Pose2& T_odom_end, bool reverse_driving) {
  const double dx = T_odom_end.x_m - T_odom_start.x_m, dy = T_odom_end.y_m - T_odom_start.y_m;
  const double distance_m = hypotenuse(dx, dy);
  if (distance_m < kTurnOnTheSpotBelow_m) return {0.0, 0.0, wrap(T_odom_end.heading_rad - T_odom_start.heading_rad)};

  const double direction_rad = std::atan2(dy, dx);
  const double first_turn_rad = wrap(direction_rad - T_odom_start.heading_rad);
  const double second_turn_rad = wrap(T_odom_end.heading_rad - direction_rad);
  if (!reverse_driving || std::abs(first_turn_rad) <= kPi / 2.0) return {distance_m, first_turn_rad, second_turn_rad};
  return {-distance_m, wrap(first_turn_rad - kPi), wrap(second_turn_rad + kPi)};
}

Pose2 move(const Pose2& T_map_body, const Control& control) {
  const double course_rad = T_map_body.heading_rad + control.first_turn_rad;
  return {T_map_body.x_m + control.distance_m * std::cos(course_rad),
          T_map_body.y_m + control.distance_m * std::sin(course_rad), wrap(course_rad + control.second_turn_rad)};
}

MotionJacobians motion_jacobians(double heading_rad, const Control& control) {
  const double course_rad = heading_rad + control.first_turn_rad;
  const double c = std::cos(course_rad), s = std::sin(course_rad), d = control.distance_m;
  MotionJacobians jacobians;
  jacobians.G << 1.0, 0.0, -d * s,  //
      0.0, 1.0, d * c,              //
      0.0, 0.0, 1.0;
  jacobians.V << c, -d * s, 0.0, 0.0,  //
      s, d * c, 0.0, 0.0,              //
      0.0, 1.0, 1.0, 1.0;
  return jacobians;
}

Eigen::Vector4d control_variances(const Control& control, const MotionNoise& noise) {
  const double length_m = std::abs(control.distance_m);
  return {length_m * noise.lambda_distance_m, std::abs(control.first_turn_rad) * noise.lambda_rotation_rad,
          std::abs(control.second_turn_rad) * noise.lambda_rotation_rad, length_m * noise.lambda_drift_rad2_per_m};
}

Eigen::Matrix3d motion_noise(double heading_rad, const Control& control, const Control& charged,
                             const MotionNoise& noise) {
  const Matrix34d V = motion_jacobians(heading_rad, control).V;
  Eigen::Matrix3d Q = V * control_variances(charged, noise).asDiagonal() * V.transpose();
  const double course_rad = heading_rad + control.first_turn_rad;
  const Eigen::Vector3d sideways(-std::sin(course_rad), std::cos(course_rad), 0.0);
  const double slip_m2 =
      std::abs(control.distance_m) * noise.sigma_lateral_m_per_sqrt_m * noise.sigma_lateral_m_per_sqrt_m;
  Q += slip_m2 * sideways * sideways.transpose();
  return Q;
}

void append(Motion& motion, const Control& control, const Control& charged, const MotionNoise& noise) {
  const double heading_rad = motion.T_start_end.heading_rad;
  const auto [G, V] = motion_jacobians(heading_rad, control);
  motion.covariance = G * motion.covariance * G.transpose() + motion_noise(heading_rad, control, charged, noise);
  const double half_turn_rad = 0.5 * wrap(control.first_turn_rad + control.second_turn_rad);
  motion.by_scales = G * motion.by_scales;
  motion.by_lag = G * motion.by_lag;
  motion.by_drift = G * motion.by_drift + 0.5 * control.distance_m * (V.col(1) + V.col(2));
  motion.by_scales.col(0) += control.distance_m * V.col(0);
  motion.by_scales.col(1) += half_turn_rad * (V.col(1) + V.col(2));
  motion.T_start_end = move(motion.T_start_end, control);
  motion.path_m += std::abs(control.distance_m);
  motion.turned_rad += std::abs(charged.first_turn_rad) + std::abs(charged.second_turn_rad);
}

void append(Motion& motion, const Motion& more) {
  const MovedPose moved = apply(motion.T_start_end, more);
  motion.covariance = moved.G * motion.covariance * moved.G.transpose() + moved.noise;
  motion.by_scales = moved.G * motion.by_scales + moved.by_scales;
  motion.by_lag = moved.G * motion.by_lag + moved.by_lag;
  motion.by_drift = moved.G * motion.by_drift + moved.by_drift;
  motion.velocity_at_end = more.velocity_at_end;
  motion.T_start_end = moved.T_map_body;
  motion.path_m += more.path_m;
  motion.turned_rad += more.turned_rad;
}

MovedPose apply(const Pose2& T_map_body, const Motion& motion) {
  MovedPose moved;
  moved.T_map_body = T_map_body * motion.T_start_end;
  moved.G << 1.0, 0.0, -(moved.T_map_body.y_m - T_map_body.y_m),  //
      0.0, 1.0, moved.T_map_body.x_m - T_map_body.x_m,            //
      0.0, 0.0, 1.0;
  const Eigen::Matrix3d R = rotation_of_pose(T_map_body.heading_rad);
  moved.noise = R * motion.covariance * R.transpose();
  moved.by_scales = R * motion.by_scales;
  moved.by_lag = R * motion.by_lag;
  moved.by_drift = R * motion.by_drift;
  return moved;
}

}  // namespace azimuth
