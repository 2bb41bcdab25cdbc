#include "slam/estimator/pose_belief.hpp"

#include "slam/ekf/considered_rig.hpp"

namespace azimuth {

/* T_map_body = T_map_camera * e^-1: the mounting adds -R for the camera's position and -1 for its yaw. The lag adds
 * R v, since the body moved on after the image was taken. */
JointState::ByConsidered PoseBelief::by_considered_of_body() const {
  JointState::ByConsidered D = by_considered;
  const Eigen::Matrix2d R = rotation(T_map_body.heading_rad);
  D.block<2, 1>(0, considered::lag) += R * velocity.head<2>();
  D(2, considered::lag) += velocity.z();
  D(2, considered::yaw) -= 1.0;
  D.block<2, 2>(0, considered::camera) -= R;
  return D;
}

Pose2 PoseBelief::body() const {
  if (believed.isZero(0.0)) return T_map_body;
  const Eigen::Vector3d way = believed(considered::lag) * velocity;
  return T_map_body * inverse(mounting(believed)) * Pose2{way.x(), way.y(), way.z()};
}

PoseBelief belief_of(const JointState& state, const RigTold& told, const Eigen::Vector3d& velocity) {
  PoseBelief belief{.T_map_body = state.pose(), .covariance = state.pose_covariance()};
  for (Index i = 0; i < 3; ++i) belief.by_considered.row(i) = state.by_considered(JointState::kPose + i);
  belief.variances = told.left;
  belief.believed = state.believed();
  belief.velocity = velocity;
  return belief;
}

/// The result has no `velocity`: the motion's derivative by the lag includes the velocity at its start.
PoseBelief moved(const PoseBelief& belief, const Motion& motion) {
  const MovedPose after = apply(belief.T_map_body, allowing_for(belief.believed, motion));
  return {.T_map_body = after.T_map_body,
          .covariance = after.G * belief.covariance * after.G.transpose() + after.noise,
          .by_considered = after.G * belief.by_considered + by_considered(belief.T_map_body, after),
          .variances = belief.variances,
          .believed = belief.believed};
}

void write_belief(const PoseBelief& belief, const AssociationCounts& counts, const Judgement& judgement,
                  Estimate& out) {
  out.T_map_body = belief.body();
  out.pose_covariance = belief.total_covariance();
  out.association = counts;
  out.health = judgement.health;
  out.reason = judgement.reason;
}

}  // namespace azimuth
