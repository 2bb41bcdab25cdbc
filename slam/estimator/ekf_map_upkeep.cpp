// EkfEstimator: what becomes of the map after an update: recovery, merging, deletion, new landmarks, promotion.

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/estimator/bearing_noise.hpp"
#include "slam/estimator/ekf_estimator.hpp"

namespace azimuth {

/// A streak of rejections must not leave the filter deaf. When nothing at all is accepted the pose is wrong, and its
/// covariance doubles until the map is heard again. When others are accepted the landmark is wrong, and starts anew.
void EkfEstimator::recover() {
  const int streak = settings_.recover_after_rejections;
  if (streak <= 0) return;
  if (deaf_sightings_ >= streak) {
    ekf_.inflate_robot(ekf_.state().pose_covariance());
    deaf_sightings_ = 0;
    ++deaf_streaks_;
    ++counts_.recovered;
  }
  for (std::size_t i = landmarks_.size(); i-- > 0;) {
    if (!maps()) break;
    const bool others_accepted = deaf_sightings_ == 0 && deaf_streaks_ == 0;
    if (landmarks_[i].rejected_in_row < streak || !others_accepted) continue;
    remove_landmark(i);
    ++counts_.recovered;
  }
}

/// In a narrow view one of two that stand close together is often seen alone, which says nothing.
void EkfEstimator::merge_duplicates(Stamp stamp) {
  if (has_names() || rig_.camera.field_of_view_rad <= kPi) return;
  list_points(stamp);
  duplicates_.observe(ekf_, points_);
  while (const auto pair = duplicates_.find(ekf_, points_)) {
    merge(*pair);
    list_points(stamp);
  }
}

void EkfEstimator::list_points(Stamp stamp) {
  points_.clear();
  for (const Landmark& landmark : landmarks_)
    if (landmark.block_kind == BlockKind::point)
      points_.push_back({landmark.id, landmark.kind, landmark.block, landmark.sightings, landmark.last_used == stamp});
}

void EkfEstimator::merge(const Duplicates::Pair& pair) {
  const auto index_of = [&](std::int64_t id) {
    return static_cast<std::size_t>(std::ranges::find_if(landmarks_, [id](const Landmark& l) { return l.id == id; }) -
                                    landmarks_.begin());
  };
  Landmark& kept = landmarks_[index_of(pair.keep)];
  const std::size_t dropped = index_of(pair.drop);
  if (!pair.agree) return remove_landmark(dropped);
  ekf_.merge(kept.block, landmarks_[dropped].block);
  forget_landmark(dropped);
}

/// Clutter: what was seen once or twice and never again.
void EkfEstimator::drop_on_probation() {
  if (has_names()) return;
  for (std::size_t i = landmarks_.size(); i-- > 0;) {
    const auto confirmed = static_cast<std::uint64_t>(settings_.confirm_after_sightings);
    if (landmarks_[i].sightings < confirmed && path_m_ - landmarks_[i].last_used_m > settings_.probation_m)
      remove_landmark(i);
  }
}

void EkfEstimator::remove_landmark(std::size_t at) {
  ekf_.remove(landmarks_[at].block, landmarks_[at].block_kind);
  forget_landmark(at);
}

void EkfEstimator::forget_landmark(std::size_t at) {
  duplicates_.forget(landmarks_[at].id);
  landmarks_[at] = landmarks_.back();
  landmarks_.pop_back();
  ++counts_.deleted;
}

/// Of features there are always more: a map needs not all of them, and each costs time in every later step.
bool EkfEstimator::sees_enough() const {
  const int enough = settings_.identity.enough_in_sight;
  return identities_ && enough > 0 && static_cast<int>(sightings_.size()) >= enough;
}

void EkfEstimator::add_unmapped(Stamp stamp) {
  if (sees_enough()) {
    for (const Bearing& bearing : unmapped_) identities_->refuse(bearing.identity);
    return;
  }
  const auto most = static_cast<std::size_t>(settings_.max_landmarks);
  const std::size_t room = most - std::min(most, landmarks_.size());
  if (unmapped_.size() > room) unmapped_.resize(room);
  if (initialisation_ == Initialisation::undelayed) {
    for (const Bearing& bearing : unmapped_) {
      const Index block =
          ekf_.add_ray(bearing.azimuth_rad, sigma_rad(bearing, rig_.camera), settings_.inverse_depth_mean_per_m,
                       settings_.inverse_depth_sigma_per_m, bearing.radius_px);
      add_landmark(
          {.identity = bearing.identity, .kind = bearing.kind, .block_kind = BlockKind::inverse_depth, .block = block},
          1, bearing.radius_px, stamp);
    }
    return;
  }
  candidates_.observe(ekf_, unmapped_);
  for (const Candidates::Created& created : candidates_.created())
    add_landmark({.identity = created.identity, .kind = created.kind, .block = created.block}, created.sightings,
                 created.radius_px, stamp);
}

void EkfEstimator::add_landmark(Landmark landmark, std::uint64_t sightings, double radius_px, Stamp stamp) {
  landmark.id = next_id_++;
  landmark.was_seen(radius_px, path_m_, stamp);
  landmark.sightings = sightings;
  landmarks_.push_back(landmark);
  last_accepted_m_ = path_m_;
  ++counts_.created;
}

void EkfEstimator::promote_converged() {
  if (initialisation_ != Initialisation::undelayed) return;
  for (Landmark& landmark : landmarks_) {
    if (landmark.block_kind != BlockKind::inverse_depth ||
        !(ekf_.linearity_index(landmark.block) < settings_.promote_linearity))
      continue;
    ekf_.promote(landmark.block);
    landmark.block_kind = BlockKind::point;
  }
}

}  // namespace azimuth
