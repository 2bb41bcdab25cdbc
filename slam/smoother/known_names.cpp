#include "slam/smoother/known_names.hpp"

#include <cmath>

namespace azimuth {
KnownNames::KnownNames(const KnownNamesSettings& settings)
    : settings_(settings), smoother_(settings.smoother), motion_(settings.floors) {}

void KnownNames::predict(const Motion& motion) { motion_.append_motion(motion); }

bool KnownNames::is_used(const Bearing& bearing, Stamp stamp) const {
  if (bearing.identity == kUnknownIdentity) return false;
  const auto known = known_.find(bearing.identity);
  return known == known_.end() || to_seconds(stamp - known->second.last_used) >= settings_.thinning_s;
}

bool KnownNames::update(const BearingSet& set) {
  motion_.image_taken(set.stamp);

  bool used_any = false;
  for (const Bearing& bearing : set.bearings) {
    if (!is_used(bearing, set.stamp)) continue;
    if (!used_any && since_anchor().moved()) {
      smoother_.add_pose(motion_.with_floors());
      motion_.pose_added();
    }
    used_any = true;
    const double sigma_rad = std::isnan(bearing.sigma_rad) ? settings_.sigma_bearing_rad : bearing.sigma_rad;
    const BearingId id = smoother_.add_bearing(bearing.azimuth_rad, sigma_rad);
    const auto [known, is_new] = known_.try_emplace(bearing.identity, Known{kOfNothing, set.stamp});
    if (is_new)
      known->second.landmark = smoother_.add_landmark(id);
    else
      smoother_.assign(id, known->second.landmark);
    known->second.last_used = set.stamp;
  }
  if (used_any) outcome_ = smoother_.optimise();
  return used_any;
}

Pose2 KnownNames::pose() const { return smoother_.newest_pose() * since_anchor().T_start_end; }

Eigen::Matrix3d KnownNames::covariance() const {
  const Eigen::Matrix3d P = smoother_.newest_covariance();
  if (!since_anchor().moved()) return P;
  const MovedPose moved = apply(smoother_.newest_pose(), motion_.with_floors());
  return moved.G * P * moved.G.transpose() + moved.noise;
}

}  // namespace azimuth
