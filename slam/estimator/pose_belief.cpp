#include "slam/estimator/pose_belief.hpp"

namespace azimuth {

PoseBelief belief_of(const JointState& state) {
  PoseBelief belief{state.pose(), state.pose_covariance()};
  for (Index i = 0; i < 3; ++i) belief.by_scales.row(i) = state.by_considered(JointState::kPose + i).head<2>();
  belief.scale_variances = state.considered();
  return belief;
}

PoseBelief moved(const PoseBelief& belief, const Motion& motion) {
  const MovedPose after = apply(belief.T_map_body, motion);
  return {after.T_map_body, after.G * belief.covariance * after.G.transpose() + after.noise,
          after.G * belief.by_scales + after.by_scales, belief.scale_variances};
}

void write_belief(const PoseBelief& belief, const AssociationCounts& counts, const Judgement& judgement,
                  Estimate& out) {
  out.T_map_body = belief.T_map_body;
  out.pose_covariance = belief.total_covariance();
  out.association = counts;
  out.health = judgement.health;
  out.reason = judgement.reason;
}

}  // namespace azimuth
