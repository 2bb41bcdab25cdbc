// EkfEstimator: what it says of robot and map.

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"
#include "slam/planar/ekf_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kUngatedSigmas = 3.0;  // shown where nothing is gated

}  // namespace

void EkfEstimator::estimate(Estimate& out) const {
  write(belief(), hearing_.path_m, out);
  out.accepted.assign(sightings_.begin(), sightings_.end());
  for (const Landmark& landmark : landmarks())
    if (landmark.confirmed) out.landmarks.push_back(estimate_of(landmark));
}

LandmarkEstimate EkfEstimator::estimate_of(const Landmark& landmark) const {
  const JointState& state = ekf_.state();
  LandmarkEstimate out;
  out.id = landmark.id;
  out.identity = names_ ? kUnknownIdentity : landmark.identity;  // ours are no sensor's names
  if (landmark.is_point()) {
    out.p_map_landmark_m = state.position(landmark.block);
    out.covariance_m2 = state.position_covariance(landmark.block) + by_scales<2>(state, landmark.block);
    return out;
  }
  Eigen::Matrix<double, 2, 4> jacobian;
  out.p_map_landmark_m = point_of(ekf_.ray(landmark.block), &jacobian);
  Eigen::Matrix4d P;
  for (Index c = 0; c < 4; ++c)
    for (Index r = 0; r < 4; ++r) P(r, c) = state.covariance(landmark.block + r, landmark.block + c);
  out.covariance_m2 = jacobian * P * jacobian.transpose() + by_scales(state, landmark.block, jacobian);
  return out;
}

void EkfEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  write(moved(belief(), motion), hearing_.path_m + motion.path_m, out);
}

void EkfEstimator::write(const PoseBelief& belief, double path_m, Estimate& out) const {
  write_belief(belief, counts(), judged(belief.covariance, path_m), out);
}

AssociationCounts EkfEstimator::counts() const {
  AssociationCounts counts = counts_;
  counts.created = map_.created();
  counts.deleted = map_.deleted();
  return counts;
}

Judgement EkfEstimator::judged(const Eigen::Matrix3d& covariance, double path_m) const {
  if (const auto judgement = lost_.judgement()) return *judgement;
  Evidence evidence = hearing_.evidence(covariance, path_m);
  evidence.landmarks = map_.size();
  evidence.max_landmarks = as_size(settings_.max_landmarks);
  evidence.centre_offset = ekf_.centre_offset();
  const Judgement judgement = judge(evidence, settings_.health);
  if (judgement.health != Health::tracking || !may_take_one_for_another()) return judgement;
  return {Health::degraded, "landmarks without names may be taken for each other, which is not noticed"};
}

/// Where nothing tells landmarks apart but where they are, a wrong pair makes the next one more likely: the filter goes
/// wrong and agrees with itself.
bool EkfEstimator::may_take_one_for_another() const {
  return !has_names() &&
         std::ranges::all_of(landmarks(), [](const Landmark& landmark) { return landmark.kind == kAnyKind; });
}

/// The innovation's gate is by S = H P H^T + R (SPEC I.6, I.7).
void EkfEstimator::expect(std::vector<ExpectedBearing>& out) const {
  const double sigmas = settings_.gates.chi2 > 0.0 ? std::sqrt(settings_.gates.chi2) : kUngatedSigmas;
  out.clear();
  for (const Landmark& landmark : landmarks())
    if (const auto predicted = view().predict_straight(landmark))
      out.push_back({.landmark = landmark.id,
                     .kind = landmark.kind,
                     .azimuth_rad = predicted->azimuth_rad,
                     .gate_rad = sigmas * std::sqrt(predicted->variance_rad2 + predicted->row.variance)});
}

/// Only points that are no longer on probation: the rest has been seen from too few places to be worth it.
bool EkfEstimator::save_map(MapSnapshot& out) const {
  out.clear();
  const JointState& state = ekf_.state();
  if (judged(state.pose_covariance(), hearing_.path_m).health == Health::lost) return false;
  saver_.clear();
  for (const Landmark& landmark : landmarks())
    if (landmark.confirmed && landmark.is_point())
      saver_.add(
          landmark.block, BlockKind::point,
          {.id = landmark.id, .identity = landmark.identity, .kind = landmark.kind, .sightings = landmark.sightings});
  if (saver_.empty()) return false;
  saver_.write(state, ekf_.camera_entries(), out);
  if (names_)
    for (const MapLandmark& landmark : out.landmarks) names_->identities().store().save(landmark.identity, out.views);
  out.names = names_of(rig_);
  out.next_id = next_id();
  out.next_identity = names_ ? names_->identities().next() : 0;
  return true;
}

}  // namespace azimuth
