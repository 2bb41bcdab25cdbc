#include "slam/planar/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/estimator/rig_noise.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

// Below this many standard deviations of parallax the relative entropy is far above any useful threshold (mathematics
// I.9: 31 at four of them); sampling the entropy would be a waste.
constexpr double kHopelessSigmas = 3.0;

}  // namespace

Candidates::Candidates(const EkfSettings& settings, const CameraRig& rig)
    : settings_(settings), rig_(rig), quality_(settings.delayed.kl_samples) {
  clones_.resize(as_size(settings.delayed.max_clones));
}

void Candidates::observe(BearingEkf& ekf, std::span<const Bearing> unmapped) {
  created_.clear();
  initialised_.clear();
  for (const Bearing& bearing : unmapped) {
    Candidate& candidate = candidate_for(bearing);
    const bool seen_already = candidate.count > 0 && candidate.bearings[candidate.count - 1].clone == Candidate::kHere;
    if (seen_already) continue;  // a name belongs to one landmark: its first bearing in the image counts
    candidate.last_image = image_;
    append(candidate, bearing);
  }
  for (std::size_t i = 0; i < candidates_.size();) {
    const std::size_t before = candidates_.size();
    if (candidates_[i].last_image == image_)
      if (const auto pair = find_pair(ekf, candidates_[i])) initialise(ekf, i, *pair);
    if (candidates_.size() == before) ++i;
  }
  for (std::size_t i = 0; i < initialised_.size(); ++i) apply_remaining(ekf, initialised_[i], created_[i].block);
  expire(ekf);
  drop_repeated(ekf);
  drop_unused_clones(ekf);
  clone_here(ekf);
  ++image_;
}

Candidate& Candidates::candidate_for(const SeenBearing& bearing) {
  for (Candidate& candidate : candidates_)
    if (candidate.identity == bearing.identity) return candidate;
  Candidate& candidate = candidates_.emplace_back();
  candidate.identity = bearing.identity;
  candidate.kind = bearing.kind;
  candidate.last_clone = clones_made_;
  return candidates_.back();
}

/// Keeps the first bearing, which has the longest baseline, and the newest ones.
void Candidates::append(Candidate& candidate, const SeenBearing& bearing) {
  if (candidate.count == Candidate::kMaxBearings) erase_bearing(candidate, 1);
  candidate.bearings[candidate.count++] = {Candidate::kHere, bearing.azimuth_rad, sigma_rad(bearing, rig_),
                                           bearing.radius_px};
}

void Candidates::erase_bearing(Candidate& candidate, std::size_t at) {
  const int clone = candidate.bearings[at].clone;
  if (clone != Candidate::kHere) --clones_[as_size(clone)].users;
  std::copy(candidate.bearings.begin() + static_cast<std::ptrdiff_t>(at) + 1,
            candidate.bearings.begin() + static_cast<std::ptrdiff_t>(candidate.count),
            candidate.bearings.begin() + static_cast<std::ptrdiff_t>(at));
  --candidate.count;
}

void Candidates::erase_candidate(std::size_t at) {
  Candidate& candidate = candidates_[at];
  while (candidate.count > 0) erase_bearing(candidate, candidate.count - 1);
  candidates_.erase(candidates_.begin() + static_cast<std::ptrdiff_t>(at));
}

/// mathematics I.9: of all pairs (earlier bearing, present bearing) under the threshold, the one with the smallest
/// relative entropy.
std::optional<Candidates::Pair> Candidates::find_pair(const BearingEkf& ekf, const Candidate& candidate) const {
  if (static_cast<int>(candidate.count) < std::max(2, settings_.delayed.min_observations)) return std::nullopt;
  const Candidate::Bearing& newest = candidate.bearings[candidate.count - 1];
  const Sighting here = ekf.sighting_from(JointState::kPose, newest.azimuth_rad, newest.radius_px);
  std::optional<Pair> best;
  for (std::size_t k = 0; k + 1 < candidate.count; ++k) {
    const Index clone = clones_[as_size(candidate.bearings[k].clone)].block;
    const Candidate::Bearing& bearing = candidate.bearings[k];
    const Sighting earlier = ekf.sighting_from(clone, bearing.azimuth_rad, bearing.radius_px);
    const auto meeting = intersect(earlier, here);
    const double sigma_rad = std::max(newest.sigma_rad, bearing.sigma_rad);
    if (!meeting || !meeting->valid() || std::abs(meeting->sine) < kHopelessSigmas * sigma_rad) continue;
    const Matrix6d P6 = ekf.joint_pose_covariance(clone, JointState::kPose);
    const double entropy = quality_.relative_entropy(earlier, here, P6, sigma_rad);
    const double to_beat = best ? best->relative_entropy : settings_.delayed.kl_threshold;
    if (!(entropy < to_beat)) continue;
    best = Pair{k, entropy, *meeting, sigma_rad};
    if (!settings_.delayed.best_pair) break;
  }
  return best;
}

void Candidates::initialise(BearingEkf& ekf, std::size_t at, const Pair& pair) {
  Candidate& candidate = candidates_[at];
  const Index clone = clones_[as_size(candidate.bearings[pair.earlier].clone)].block;
  const auto by_camera = [&](const Candidate::Bearing& bearing) {
    return ekf.by_camera(bearing.azimuth_rad, bearing.radius_px);
  };
  Eigen::Matrix<double, 2, 4> both;
  both << by_camera(candidate.bearings[pair.earlier]), by_camera(candidate.bearings[candidate.count - 1]);
  const Index block = ekf.add_point(pair.meeting, clone, JointState::kPose, pair.sigma_rad, both);
  created_.push_back({candidate.identity, candidate.kind, block, candidate.count, pair.relative_entropy,
                      candidate.bearings[candidate.count - 1].radius_px});
  initialised_.push_back(candidate);  // its clones live until drop_unused_clones()
  Candidate& rest = initialised_.back();
  rest.bearings[pair.earlier] = rest.bearings[rest.count - 2];  // the pair must not be used again
  rest.count -= 2;
  erase_candidate(at);
}

/// mathematics I.2 step 5: one batch update with the bearings that were not used by the pair.
void Candidates::apply_remaining(BearingEkf& ekf, const Candidate& candidate, Index block) {
  remaining_.clear();
  for (const Candidate::Bearing& bearing : candidate.seen()) {
    const double variance = bearing.sigma_rad * bearing.sigma_rad;
    const MappedSighting sighting{clones_[as_size(bearing.clone)].block,
                                  block,
                                  BlockKind::point,
                                  bearing.azimuth_rad,
                                  variance,
                                  bearing.radius_px};
    const auto row = ekf.linearise(sighting);
    if (!row) continue;
    const double S = ekf.prediction_covariance(*row, *row) + variance;
    if (settings_.delayed.gate_remaining && settings_.gates.chi2 > 0.0 &&
        row->innovation * row->innovation > settings_.gates.chi2 * S)
      continue;
    remaining_.push_back(sighting);
  }
  ekf.update(remaining_);
}

/// Drops candidates that have not been seen for long, so that their clones do not stay for ever (mathematics I.2). Time
/// is counted in clones: nothing expires while the robot stands still.
void Candidates::expire(const BearingEkf& ekf) {
  if (settings_.delayed.expire_after_clones <= 0) return;
  const auto limit = static_cast<std::uint64_t>(settings_.delayed.expire_after_clones);
  const Eigen::Vector2d p_map_robot = ekf.state().position(JointState::kPose);
  for (std::size_t i = candidates_.size(); i-- > 0;) {
    const Candidate& candidate = candidates_[i];
    if (candidate.last_image == image_) continue;
    const Index oldest = clones_[as_size(candidate.bearings[0].clone)].block;
    const double away_m = (ekf.state().position(oldest) - p_map_robot).norm();
    if (clones_made_ - candidate.last_clone > limit || away_m > 2.0 * settings_.max_viewing_distance_m)
      erase_candidate(i);
  }
}

void Candidates::drop_unused_clones(BearingEkf& ekf) {
  for (Clone& clone : clones_) {
    if (clone.users > 0 || clone.block == 0) continue;
    ekf.remove(clone.block, BlockKind::pose);
    clone.block = 0;
  }
}

/// A bearing from nearly the same place as the last one of its landmark adds no parallax and is not worth a clone.
void Candidates::drop_repeated(const BearingEkf& ekf) {
  if (settings_.delayed.min_clone_baseline_m <= 0.0) return;
  const Eigen::Vector2d p_map_robot = ekf.state().position(JointState::kPose);
  for (Candidate& candidate : candidates_) {
    if (candidate.count < 2 || candidate.bearings[candidate.count - 1].clone != Candidate::kHere) continue;
    const Index last = clones_[as_size(candidate.bearings[candidate.count - 2].clone)].block;
    if ((ekf.state().position(last) - p_map_robot).norm() < settings_.delayed.min_clone_baseline_m) --candidate.count;
  }
}

/// mathematics I.2 step 7: clones the robot's pose if a candidate has a bearing from it.
void Candidates::clone_here(BearingEkf& ekf) {
  const auto wants_clone = [](const Candidate& candidate) {
    return candidate.count > 0 && candidate.bearings[candidate.count - 1].clone == Candidate::kHere;
  };
  if (std::none_of(candidates_.begin(), candidates_.end(), wants_clone)) return;
  const std::size_t slot = free_slot(ekf);
  clones_[slot] = {ekf.clone_robot(), image_, 0};
  ++clones_made_;
  for (Candidate& candidate : candidates_) {
    if (!wants_clone(candidate)) continue;
    candidate.bearings[candidate.count - 1].clone = static_cast<int>(slot);
    candidate.last_clone = clones_made_;
    ++clones_[slot].users;
  }
}

/// A free slot for a clone. If there is none, the oldest clone and its bearings are dropped.
std::size_t Candidates::free_slot(BearingEkf& ekf) {
  const auto is_free = [](const Clone& clone) { return clone.block == 0; };
  const auto found = std::find_if(clones_.begin(), clones_.end(), is_free);
  if (found != clones_.end()) return as_size(found - clones_.begin());
  const auto oldest = std::min_element(clones_.begin(), clones_.end(),
                                       [](const Clone& a, const Clone& b) { return a.image < b.image; });
  const auto slot = as_size(oldest - clones_.begin());
  for (std::size_t i = candidates_.size(); i-- > 0;) {
    Candidate& candidate = candidates_[i];
    for (std::size_t k = candidate.count; k-- > 0;)
      if (candidate.bearings[k].clone == static_cast<int>(slot)) erase_bearing(candidate, k);
    if (candidate.count == 0) erase_candidate(i);
  }
  ekf.remove(oldest->block, BlockKind::pose);
  return slot;
}

}  // namespace azimuth
