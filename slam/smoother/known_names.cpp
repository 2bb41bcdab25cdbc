#include "slam/smoother/known_names.hpp"

#include <algorithm>

namespace azimuth {
namespace {

// Nobody knows when a motion before the first image began.
constexpr double kShortest_s = 1e-3;

/// append() of a whole motion leaves out what errors of the scales do.
void append_with_scales(Motion& motion, const Motion& more) {
  const MovedPose moved = apply(motion.T_start_end, more);
  motion.by_scales = moved.G * motion.by_scales + moved.by_scales;
  append(motion, more);
}

}  // namespace

KnownNames::KnownNames(const KnownNamesSettings& settings) : settings_(settings), smoother_(settings.smoother) {}

void KnownNames::predict(const Motion& motion) {
  append_with_scales(motion_, motion);
  moved_ = moved_ || motion.moved();
}

bool KnownNames::is_used(const Bearing& bearing, Stamp stamp) const {
  if (bearing.identity == kUnknownIdentity) return false;
  const auto known = known_.find(bearing.identity);
  return known == known_.end() || to_seconds(stamp - known->second.last_used) >= settings_.thinning_s;
}

Motion KnownNames::with_floors(Motion motion) const {
  const double distance_m2 = settings_.floor_distance_m * settings_.floor_distance_m;
  const double rotation_rad2 = settings_.floor_rotation_rad * settings_.floor_rotation_rad;
  motion.covariance.diagonal() +=
      std::max(moving_s_, kShortest_s) * Eigen::Vector3d(distance_m2, distance_m2, rotation_rad2);
  return motion;
}

bool KnownNames::update(const BearingSet& set) {
  if (moved_ && last_image_) moving_s_ += to_seconds(set.stamp - *last_image_);
  last_image_ = set.stamp;
  moved_ = false;

  bool used_any = false;
  for (const Bearing& bearing : set.bearings) {
    if (!is_used(bearing, set.stamp)) continue;
    if (!used_any && motion_.moved()) {
      smoother_.add_pose(with_floors(motion_));
      motion_ = Motion{};
      moving_s_ = 0.0;
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

Pose2 KnownNames::pose() const { return smoother_.newest_pose() * motion_.T_start_end; }

Eigen::Matrix3d KnownNames::covariance() const {
  const Eigen::Matrix3d P = smoother_.newest_covariance();
  if (!motion_.moved()) return P;
  const MovedPose moved = apply(smoother_.newest_pose(), with_floors(motion_));
  return moved.G * P * moved.G.transpose() + moved.noise;
}

}  // namespace azimuth
