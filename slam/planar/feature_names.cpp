#include "slam/planar/feature_names.hpp"

#include <algorithm>
#include <functional>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// Variance of the difference between the robot's heading and a clone's.
double turn_variance_rad2(const JointState& state, Index clone) {
  const Index then = clone + 2, now = JointState::kPose + 2;
  return state.covariance(then, then) + state.covariance(now, now) - 2.0 * state.covariance(then, now);
}

/// Replaces `out.sighted` and the pose.
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

}  // namespace

const BearingSet& FeatureNames::name(const BearingSet& image, std::span<const PlanarLandmark> landmarks,
                                     const Candidates& candidates, const PlanarView& view, bool pose_is_a_guess) {
  write_sighted(view.ekf(), candidates, beliefs_);
  beliefs_.anywhere = pose_is_a_guess;
  beliefs_.mapped.clear();
  for (const PlanarLandmark& landmark : landmarks) {
    IdentityBeliefs::Mapped& mapped = beliefs_.mapped.emplace_back();
    mapped.identity = landmark.identity;
    if (const auto predicted = view.predict_straight(landmark)) {
      mapped.azimuth_rad = predicted->azimuth_rad;
      mapped.variance_rad2 = predicted->variance_rad2;
    }
  }
  std::ranges::sort(beliefs_.mapped, std::less{}, &IdentityBeliefs::Mapped::identity);
  return identities_.name(image, beliefs_);
}

}  // namespace azimuth
