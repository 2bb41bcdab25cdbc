#pragma once
// The odometer's scales, drift and lag, and the camera's mounting, as constants that a filter considers.
//
// Bearings carry no information on the scale of distance: a map twice as large, driven through twice as far, looks the
// same. A scale error s stays in path and map for good. The uncertainty that it causes, sigma_s^2 p p^T as seen from
// the first pose, grows with the distance from the first pose and vanishes on return to it. Noise added in each step
// models neither. The scale of turns is observable, and is determined by what corrects the heading; its remaining error
// is considered here.
//
// If the camera's mounting differs from the rig's by e = (e_x, e_y, e_yaw), the camera sees from T_map_body * e. The
// filter estimates that pose: its bearings are right, and its motions are off, e^-1 * motion * e. So only the motion,
// the first pose, and the conversion to the robot's pose depend on e.
//
// All constants are carried as described at JointState::consider(). A filter that accounts for the scale of distance in
// its gains (Schmidt 1966) gains nothing, since bearings do not observe the scale, and is worse in practice: anything
// correlated with the scale, above all the guess of a new landmark's distance, then moves the whole map.

#include <Eigen/Core>
#include <cmath>

#include "slam/ekf/joint_state.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// d(pose') / d(errors), where `moved` is the result of a motion from `T_map_camera`. The camera's yaw contributes
/// -perp(p' - p), its position R' - R.
inline JointState::ByConsidered by_considered(const Pose2& T_map_camera, const MovedPose& moved) {
  const Eigen::Vector2d went = moved.T_map_body.position() - T_map_camera.position();
  JointState::ByConsidered B = JointState::ByConsidered::Zero();
  B.col(considered::scale_distance) = moved.by_scales.col(0);
  B.col(considered::scale_turn) = moved.by_scales.col(1);
  B.col(considered::lag) = moved.by_lag;
  B.col(considered::drift) = moved.by_drift;
  B.col(considered::yaw) << went.y(), -went.x(), 0.0;
  B.block<2, 2>(0, considered::camera) = rotation(moved.T_map_body.heading_rad) - rotation(T_map_camera.heading_rad);
  return B;
}

/// The error of the camera's mounting.
inline Pose2 mounting(const Considered& errors) {
  return {errors(considered::camera), errors(considered::camera + 1), errors(considered::yaw)};
}

/// The camera's motion when these errors of the rig are taken into account: e^-1 * (motion + B errors) * e.
inline Motion allowing_for(const Considered& errors, Motion motion) {
  const Eigen::Vector3d off = motion.by_scales * errors.head<2>() + motion.by_lag * errors(considered::lag) +
                              motion.by_drift * errors(considered::drift);
  Pose2& T = motion.T_start_end;
  T = {T.x_m + off.x(), T.y_m + off.y(), wrap(T.heading_rad + off.z())};
  T = inverse(mounting(errors)) * T * mounting(errors);
  return motion;
}

/// mathematics I.3, eq 15 to 18, for a motion that may consist of many segments.
inline void move(const Motion& motion, JointState& state) {
  const bool allows = !state.believed().isZero(0.0);
  const MovedPose moved = apply(state.pose(), allows ? allowing_for(state.believed(), motion) : motion);
  state.move_robot(moved.T_map_body, moved.G, moved.noise, by_considered(state.pose(), moved));
}

/// Derivative by the errors of a position in a map whose origin is the first pose: the map scales with the odometer,
/// and is turned and shifted with the camera's mounting. Columns: [p, perp(p), I]
inline Eigen::Matrix<double, 2, considered::kCount> of_place(const Eigen::Vector2d& p_map) {
  Eigen::Matrix<double, 2, considered::kCount> D = Eigen::Matrix<double, 2, considered::kCount>::Zero();
  D.col(considered::scale_distance) = p_map;
  D.col(considered::yaw) << -p_map.y(), p_map.x();
  D.middleCols<2>(considered::camera).setIdentity();
  return D;
}
inline void set_of_place(Index position, JointState& state) {
  const auto D = of_place(state.position(position));
  for (const Index i : {0, 1}) state.set_by_considered(position + i, D.row(i));
}
/// Sets the derivatives of the robot's pose when the robot is placed in a map whose origin is the first pose, or starts
/// such a map, uncorrelated with the other states.
inline void set_of_placed_robot(JointState& state) {
  set_of_place(JointState::kPose, state);
  state.set_by_considered(JointState::kHeading, Considered::Unit(considered::yaw).transpose());
}

/// Covariance due to the considered errors of J times the `Size` entries from `block` on: J D diag(variances) D^T J^T.
template <int Rows, int Size>
Eigen::Matrix<double, Rows, Rows> covariance_by_considered(const JointState& state, Index block,
                                                           const Eigen::Matrix<double, Rows, Size>& J) {
  Eigen::Matrix<double, Size, considered::kCount> D;
  for (Index i = 0; i < Size; ++i) D.row(i) = state.by_considered(block + i);
  const Eigen::Matrix<double, Rows, considered::kCount> JD = J * D;
  return JD * state.considered().asDiagonal() * JD.transpose();
}
template <int Size>
Eigen::Matrix<double, Size, Size> covariance_by_considered(const JointState& state, Index block) {
  return covariance_by_considered<Size, Size>(state, block, Eigen::Matrix<double, Size, Size>::Identity());
}

}  // namespace azimuth
