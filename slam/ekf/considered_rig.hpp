#pragma once
// The odometer's scales, drift and lag and the camera's mounting as constants that a filter considers.
//
// No bearing tells the scale of distance: a map twice as large, driven through twice as far, looks the same. An error s
// of it stays in path and map for good, and what it makes uncertain, sigma_s^2 p p^T as seen from the first pose, grows
// with the distance from there and is gone on return. Noise added step by step says neither. The scale of turn can be
// told, and is, by what corrects the heading; what is left of it shows here.
//
// A camera that is mounted otherwise than the rig says, by e = (e_x, e_y, e_yaw), sees from T_map_body * e, and that is
// the pose that the filter estimates: bearings of it are as they should be, and what is off are its motions, e^-1 *
// motion * e. So nothing but the motion depends on e, the first pose, and the robot's when it is told.
//
// All are carried as JointState::consider() says. A filter that knows of the scale of distance in its gains (Schmidt
// 1966) would be better by nothing, since bearings say nothing of it, and worse in practice: whatever else says
// something of it, the guess of a new landmark's distance above all, then moves the whole map.

#include <Eigen/Core>
#include <cmath>

#include "slam/ekf/joint_state.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// d(pose') / d(errors), `moved` being where a motion leads from `T_map_camera`:
///   by the camera's yaw -perp(p' - p), by its place R' - R.
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

/// By how much the camera is mounted otherwise.
inline Pose2 mounting(const Considered& errors) {
  return {errors(considered::camera), errors(considered::camera + 1), errors(considered::yaw)};
}

/// The camera's motion if such errors of the rig are allowed for: e^-1 * (motion + B errors) * e.
inline Motion allowing_for(const Considered& errors, Motion motion) {
  const Eigen::Vector3d off = motion.by_scales * errors.head<2>() + motion.by_lag * errors(considered::lag) +
                              motion.by_drift * errors(considered::drift);
  Pose2& T = motion.T_start_end;
  T = {T.x_m + off.x(), T.y_m + off.y(), wrap(T.heading_rad + off.z())};
  T = inverse(mounting(errors)) * T * mounting(errors);
  return motion;
}

/// SPEC I.3, eq 15 to 18, by a motion carried over many segments.
inline void move(const Motion& motion, JointState& state) {
  const bool allows = !state.believed().isZero(0.0);
  const MovedPose moved = apply(state.pose(), allows ? allowing_for(state.believed(), motion) : motion);
  state.move_robot(moved.T_map_body, moved.G, moved.noise, by_considered(state.pose(), moved));
}

/// What the errors make of a place in a map that began at its origin with the robot there: it is as large as the
/// odometer counts, and stands as the camera was mounted. [p, perp(p), I]
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
/// The pose's, where it is put into such a map, or begins one, by what has to do with nothing else in the state.
inline void set_of_placed_robot(JointState& state) {
  set_of_place(JointState::kPose, state);
  state.set_by_considered(JointState::kHeading, Considered::Unit(considered::yaw).transpose());
}

/// What the errors make uncertain of the `Size` entries from `block` on, by rows of J: J D diag(variances) D^T J^T.
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
