#pragma once
#include <Eigen/Core>

#include "slam/ekf/rig_told.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

// Thread contract: reentrant.

/// What the filter believes: pose in the map frame, covariance of (x [m], y [m], heading [rad]).
struct PoseBelief {
  Pose2 T_map_body;            ///< as the filter has it: see `believed`
  Eigen::Matrix3d covariance;  ///< within the map, as it would be if the rig had no error
  // Its errors, where the filter considers them.
  /// What they have made of the pose by now: of the camera's, as of when images are taken (considered_rig.hpp).
  JointState::ByConsidered by_considered = JointState::ByConsidered::Zero();
  Considered variances = Considered::Zero();
  Considered believed = Considered::Zero();  ///< errors that the filter allows for
  /// How the robot goes on from there until the instant that the pose is of, body frame (m/s, m/s, rad/s); zero: the
  /// pose is of that instant already.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();

  /// The pose of the body, at the instant that it is of.
  Pose2 body() const;
  /// d(pose of the body, at the instant that it is of) / d(errors).
  JointState::ByConsidered by_considered_of_body() const;
  /// As seen from outside: the map may be too large, and the path with it.
  Eigen::Matrix3d total_covariance() const {
    const JointState::ByConsidered D = by_considered_of_body();
    return covariance + D * variances.asDiagonal() * D.transpose();
  }
};

/// Of the robot in a filter's state, which goes at `velocity`, by what innovations have told of the rig.
PoseBelief belief_of(const JointState& state, const RigTold& told, const Eigen::Vector3d& velocity);

/// What it will believe after `motion`, which begins at the instant of the pose, and nothing else:
/// P' = G P G^T + R Q R^T, D' = G D + B.
PoseBelief moved(const PoseBelief& belief, const Motion& motion);

/// What an estimate says of everything but the map.
void write_belief(const PoseBelief& belief, const AssociationCounts& counts, const Judgement& judgement, Estimate& out);

}  // namespace azimuth
