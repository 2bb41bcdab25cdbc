#include "slam/hypotheses/nameless.hpp"

#include <cmath>

namespace azimuth {

Nameless::Nameless(const NamelessSettings& settings)
    : settings_(settings), beam_(settings.beam), motion_(settings.floors) {}

void Nameless::predict(const Motion& motion) { motion_.append_motion(motion); }

bool Nameless::is_used(const BearingSet& set) const {
  if (!last_used_) return true;
  return since_anchor().moved() && to_seconds(set.stamp - *last_used_) >= settings_.thinning_s;
}

bool Nameless::update(const BearingSet& set, Workers& workers) {
  motion_.image_taken(set.stamp);
  if (!is_used(set)) return false;

  sightings_.clear();
  const double sigma_rad = settings_.beam.hypothesis.scene.sigma_bearing_rad;
  for (const Bearing& bearing : set.bearings)
    sightings_.push_back({bearing.azimuth_rad, std::isnan(bearing.sigma_rad) ? sigma_rad : bearing.sigma_rad});
  if (last_used_)
    beam_.add_image(since_anchor_with_floors(), sightings_, workers);
  else
    beam_.begin(sightings_);
  last_used_ = set.stamp;
  motion_.pose_added();
  return true;
}

Beam::PoseBelief Nameless::pose() const {
  Beam::PoseBelief belief = beam_.newest_pose();
  if (!since_anchor().moved()) return belief;
  const MovedPose moved = apply(belief.T_map_body, since_anchor_with_floors());
  belief.covariance = moved.G * belief.covariance * moved.G.transpose() + moved.noise;
  belief.T_map_body = moved.T_map_body;
  return belief;
}

}  // namespace azimuth
