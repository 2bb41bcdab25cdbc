#include "slam/hypotheses/nameless.hpp"

#include <cmath>

namespace azimuth {

Nameless::Nameless(const NamelessSettings& settings) : settings_(settings), beam_(settings.beam) {}

/// append() of a whole motion leaves out what errors of the scales do.
void Nameless::predict(const Motion& motion) {
  const MovedPose moved = apply(motion_.T_start_end, motion);
  motion_.by_scales = moved.G * motion_.by_scales + moved.by_scales;
  append(motion_, motion);
  moved_ = moved_ || motion.moved();
}

bool Nameless::is_used(const BearingSet& set) const {
  if (!last_used_) return true;
  return motion_.moved() && to_seconds(set.stamp - *last_used_) >= settings_.thinning_s;
}

Motion Nameless::since_anchor_with_floors() const {
  Motion motion = motion_;
  const double distance_m2 = settings_.floor_distance_m * settings_.floor_distance_m;
  const double rotation_rad2 = settings_.floor_rotation_rad * settings_.floor_rotation_rad;
  motion.covariance.diagonal() += moving_s_ * Eigen::Vector3d(distance_m2, distance_m2, rotation_rad2);
  return motion;
}

bool Nameless::update(const BearingSet& set, Workers& workers) {
  if (moved_ && last_image_) moving_s_ += to_seconds(set.stamp - *last_image_);
  last_image_ = set.stamp;
  moved_ = false;
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
  motion_ = Motion{};
  moving_s_ = 0.0;
  return true;
}

Beam::PoseBelief Nameless::pose() const {
  Beam::PoseBelief belief = beam_.newest_pose();
  if (!motion_.moved()) return belief;
  const MovedPose moved = apply(belief.T_map_body, since_anchor_with_floors());
  belief.covariance = moved.G * belief.covariance * moved.G.transpose() + moved.noise;
  belief.T_map_body = moved.T_map_body;
  return belief;
}

}  // namespace azimuth
