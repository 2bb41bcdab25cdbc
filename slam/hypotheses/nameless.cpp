#include "slam/hypotheses/nameless.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

// Of two nearer than this, in standard deviations, nobody could say later which was which.
constexpr double kNearSigmas = 1.6;

/// Sightings side by side become one, in the middle of them.
void unite_near(std::vector<Sighting>& sightings) {
  std::stable_sort(sightings.begin(), sightings.end(),
                   [](const Sighting& a, const Sighting& b) { return a.azimuth_rad < b.azimuth_rad; });
  std::vector<Sighting> united;
  int count = 0;
  for (const Sighting& sighting : sightings) {
    if (!united.empty() && sighting.azimuth_rad - united.back().azimuth_rad < kNearSigmas * sighting.sigma_rad) {
      ++count;
      united.back().azimuth_rad += (sighting.azimuth_rad - united.back().azimuth_rad) / count;
    } else {
      united.push_back(sighting);
      count = 1;
    }
  }
  sightings = std::move(united);
}

}  // namespace

Nameless::Nameless(const NamelessSettings& settings)
    : settings_(settings), beam_(settings.beam), motion_(settings.floors), whole_motion_(settings.floors) {}

void Nameless::predict(const Motion& motion) {
  motion_.append_motion(motion);
  if (last_used_) whole_motion_.append_motion(motion);
}

bool Nameless::is_used(const BearingSet& set) const {
  if (!last_used_) return true;
  return since_anchor().moved() &&
         (to_seconds(set.stamp - *last_used_) >= settings_.thinning_s || since_anchor().path_m >= settings_.far_m);
}

bool Nameless::update(const BearingSet& set, Workers& workers) {
  motion_.image_taken(set.stamp);
  whole_motion_.image_taken(set.stamp);
  if (!is_used(set)) return false;

  sightings_.clear();
  const double sigma_rad = settings_.beam.hypothesis.scene.sigma_bearing_rad;
  for (const Bearing& bearing : set.bearings)
    sightings_.push_back({bearing.azimuth_rad, std::isnan(bearing.sigma_rad) ? sigma_rad : bearing.sigma_rad});
  if (settings_.beam.hypothesis.tracks.used) unite_near(sightings_);
  if (last_used_)
    beam_.add_image(since_anchor_with_floors(), sightings_, workers, to_seconds(set.stamp - *last_used_));
  else
    beam_.begin(sightings_);
  last_used_ = set.stamp;
  motion_.pose_added();
  evidence_ = trust_evidence(beam_, odometry_alone());
  return true;
}

Beam::PoseBelief Nameless::pose() const {
  Beam::PoseBelief belief = beam_.newest_pose();
  if (since_anchor().moved()) {
    const MovedPose moved = apply(belief.T_map_body, since_anchor_with_floors());
    belief.covariance = moved.G * belief.covariance * moved.G.transpose() + moved.noise;
    belief.T_map_body = moved.T_map_body;
  }
  const Beam::PoseBelief odometry = odometry_alone();
  Eigen::Vector3d off = odometry.T_map_body.vector() - belief.T_map_body.vector();
  off.z() = wrap(off.z());
  const double wrong = probability_all_wrong(evidence_);
  belief.covariance = (1.0 - wrong) * belief.covariance + wrong * (odometry.covariance + off * off.transpose());
  return belief;
}

Beam::PoseBelief Nameless::odometry_alone() const {
  const Motion motion = whole_motion_.with_floors();
  const Eigen::Vector2d sigmas(settings_.sigma_scale_distance, settings_.sigma_scale_turn);
  const ByScales by_scales = motion.by_scales * sigmas.asDiagonal();
  return {motion.T_start_end, motion.covariance + by_scales * by_scales.transpose()};
}

}  // namespace azimuth
