#include "slam/planar/identity_beliefs.hpp"

#include <algorithm>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// Variance of the difference between the robot's heading and a clone's.
double turn_variance_rad2(const JointState& state, Index clone) {
  const Index then = clone + 2, now = JointState::kPose + 2;
  return state.covariance(then, then) + state.covariance(now, now) - 2.0 * state.covariance(then, now);
}

}  // namespace

void write_sighted(const BearingEkf& ekf, const Candidates& candidates, IdentityBeliefs& out) {
  out.T_map_camera = ekf.state().pose();
  out.T_map_camera.heading_rad = wrap(out.T_map_camera.heading_rad + ekf.yaw_offset_rad());
  out.sighted.clear();
  for (const Candidate& candidate : candidates.candidates())
    for (const Candidate::Bearing& bearing : candidate.seen()) {
      const Index clone = candidates.clones()[as_size(bearing.clone)].block;
      const Sighting then = ekf.sighting_from(clone, bearing.azimuth_rad, bearing.radius_px);
      out.sighted.push_back({candidate.identity, then.T_map_body.position(),
                             wrap(then.T_map_body.heading_rad + then.azimuth_rad),
                             bearing.sigma_rad * bearing.sigma_rad, turn_variance_rad2(ekf.state(), clone)});
    }
  std::ranges::sort(out.sighted, std::less{}, &IdentityBeliefs::Sighted::identity);
}

}  // namespace azimuth
