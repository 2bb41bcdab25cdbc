#pragma once
#include <Eigen/Core>

#include "slam/ekf/rig_told.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

// Thread contract: reentrant.

/// The filter's belief of the robot: pose in the map frame and covariance of (x [m], y [m], heading [rad]).
struct PoseBelief {
  Pose2 T_map_body;            ///< The filter's pose: the camera's errors in `believed` are not taken out
  Eigen::Matrix3d covariance;  ///< Relative to the map, as if the rig had no error
  // Errors of the rig, where the filter considers them.
  /// d(pose) / d(errors), at the instant at which images are taken (considered_rig.hpp).
  JointState::ByConsidered by_considered = JointState::ByConsidered::Zero();
  Considered variances = Considered::Zero();
  Considered believed = Considered::Zero();  ///< Errors that the filter allows for
  /// Velocity of the robot from the instant of T_map_body to the instant of the estimate, body frame (m/s, m/s, rad/s).
  /// Zero: T_map_body is at the instant of the estimate.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();

  /// The pose of the body at the instant of the estimate.
  Pose2 body() const;
  /// d(body()) / d(errors).
  JointState::ByConsidered by_considered_of_body() const;
  /// Covariance in the world: includes the unknown scale of map and path.
  Eigen::Matrix3d total_covariance() const {
    const JointState::ByConsidered D = by_considered_of_body();
    return covariance + D * variances.asDiagonal() * D.transpose();
  }
};

/// The belief of the robot in a filter's state, moving at `velocity`; the errors' variances come from what innovations
/// have told of the rig.
PoseBelief belief_of(const JointState& state, const RigTold& told, const Eigen::Vector3d& velocity);

/// The belief predicted by `motion`, which starts at the instant of the pose: P' = G P G^T + R Q R^T, D' = G D + B.
PoseBelief moved(const PoseBelief& belief, const Motion& motion);

/// Writes everything into an estimate except the map.
void write_belief(const PoseBelief& belief, const AssociationCounts& counts, const Judgement& judgement, Estimate& out);

}  // namespace azimuth
