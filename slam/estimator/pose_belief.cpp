#include "slam/estimator/pose_belief.hpp"

namespace azimuth {

PoseBelief moved(const PoseBelief& belief, const Motion& motion) {
  const MovedPose after = apply(belief.T_map_body, motion);
  return {after.T_map_body, after.G * belief.covariance * after.G.transpose() + after.noise};
}

void write_belief(const PoseBelief& belief, const AssociationCounts& counts, const Judgement& judgement,
                  Estimate& out) {
  out.T_map_body = belief.T_map_body;
  out.pose_covariance = belief.covariance;
  out.association = counts;
  out.health = judgement.health;
  out.reason = judgement.reason;
}

}  // namespace azimuth
