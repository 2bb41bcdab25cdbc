#pragma once
// The odometer's scales, of distance and of turn, as constants that a filter considers.
//
// No bearing tells the scale of distance: a map twice as large, driven through twice as far, looks the same. An error s
// of it stays in path and map for good, and what it makes uncertain, sigma_s^2 p p^T as seen from the first pose, grows
// with the distance from there and is gone on return. Noise added step by step says neither. The scale of turn can be
// told, and is, by what corrects the heading; what is left of it shows here.
//
// Both are carried as JointState::consider() says. A filter that knows of the error in its gains (Schmidt 1966) would
// be better by nothing, since bearings say nothing of the scale, and worse in practice: whatever else says something of
// it, the guess of a new landmark's distance above all, then moves the whole map.

#include <Eigen/Core>
#include <cmath>

#include "slam/ekf/joint_state.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// SPEC I.3, eq 15 to 18, by a motion carried over many segments.
inline void move(const Motion& motion, JointState& state) {
  const MovedPose moved = apply(state.pose(), motion);
  JointState::ByConsidered B;
  B << moved.by_scales, moved.by_lag;
  state.move_robot(moved.T_map_body, moved.G, moved.noise, B);
}

/// What the scales make uncertain of the `Size` entries from `block` on, by rows of J: J D diag(variances) D^T J^T.
template <int Rows, int Size>
Eigen::Matrix<double, Rows, Rows> by_scales(const JointState& state, Index block,
                                            const Eigen::Matrix<double, Rows, Size>& J) {
  Eigen::Matrix<double, Size, 2> D;
  for (Index i = 0; i < Size; ++i) D.row(i) = state.by_considered(block + i).head<2>();
  const Eigen::Matrix<double, Rows, 2> JD = J * D;
  return JD * state.considered().asDiagonal() * JD.transpose();
}
template <int Size>
Eigen::Matrix<double, Size, Size> by_scales(const JointState& state, Index block) {
  return by_scales<Size, Size>(state, block, Eigen::Matrix<double, Size, Size>::Identity());
}

}  // namespace azimuth
