// Propagation of the best particle's error covariance (docs/mathematics.md II.11).

#include <algorithm>

#include "slam/fastslam/fastslam.hpp"
#include "slam/fastslam/ray_fit.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// Propagates the errors through the step of the particle that was the best before this image. Most particles take
/// nearly the same step, and which particle becomes the best is known only after the step.
void FastSlam::follow_proposal(const ParticleStep& step, const Symmetric3& proposal) {
  errors_.begin_image(seen_.size());
  for (const std::size_t l : recognition_.by_certainty()) {
    const ExpectedLamp& lamp = *recognition_.lamp_of(l);
    const auto slot = as_size(lamp.slot);
    errors_.sight(l, particles_.infos(step.k)[slot].id, lamp.view, particles_.covariances(step.k)[slot],
                  seen_[l].covariance);
  }
  errors_.draw(proposal);
}

/// A new landmark can be mapped only from a pose that detects something unmapped, so only such poses are kept.
void FastSlam::follow_pose() {
  bool all_known = true;
  for (std::size_t l = 0; l < seen_.size(); ++l) all_known = all_known && recognition_.lamp_of(l) != nullptr;
  if (!all_known) errors_.keep_pose(step_);
}

/// Follows the new best particle: landmarks that only this particle has mapped are added as if mapped just now.
void FastSlam::follow_best() {
  const auto infos = particles_.infos(best_);
  errors_.keep_if([&](std::int64_t id) { return std::ranges::find(infos, id, &LampInfo::id) != infos.end(); });
  for (std::size_t slot = 0; slot < infos.size(); ++slot)
    if (!errors_.has(infos[slot].id))
      errors_.add(infos[slot].id, particles_[best_].T_map_body, particles_.positions(best_)[slot],
                  particles_.mapped_with(best_)[slot]);
}

/// Adds a new landmark. The errors of the poses from which it was mapped are known as far as these poses are kept.
void FastSlam::follow_new(const LampCandidate& candidate, const Eigen::Vector3d& p_map) {
  const auto sightings = std::span(candidate.sightings).first(candidate.sighting_count);
  std::size_t kept = sightings.size() - 1;
  while (kept > 0 && errors_.keeps_pose(sightings[kept - 1].step)) --kept;
  const LampFitError error = error_of_fit(candidate_work_.rays, candidate_work_.gathered, p_map, kept);
  for (; kept < sightings.size(); ++kept) errors_.mapped_from(sightings[kept].step, error.by_poses[kept]);
  errors_.add(candidate.id, error.own);
}

}  // namespace azimuth
