// EkfEstimator: output of robot and map.

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"
#include "slam/planar/ekf_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kUngatedSigmas = 3.0;  // gate to display where no gate is set

}  // namespace

void EkfEstimator::estimate(Estimate& out) const {
  write_robot(out);
  for (const Landmark& landmark : landmarks())
    if (landmark.confirmed) out.landmarks.push_back(estimate_of(landmark));
}

LandmarkEstimate EkfEstimator::estimate_of(const Landmark& landmark) const {
  const JointState& state = ekf_.state();
  LandmarkEstimate out;
  out.id = landmark.id;
  // identities assigned by FeatureNames are not the sensor's names
  out.identity = names_ ? kUnknownIdentity : landmark.identity;
  if (landmark.is_point()) {
    out.p_map_landmark_m = state.position(landmark.block);
    out.covariance_m2 = state.position_covariance(landmark.block) + covariance_by_considered<2>(state, landmark.block);
    return out;
  }
  Eigen::Matrix<double, 2, 4> jacobian;
  out.p_map_landmark_m = point_of(ekf_.ray(landmark.block), &jacobian);
  const Eigen::Matrix4d P = state.block_covariance<4>(landmark.block, landmark.block);
  out.covariance_m2 = jacobian * P * jacobian.transpose() + covariance_by_considered(state, landmark.block, jacobian);
  return out;
}

Judgement EkfEstimator::judged_with_map(Evidence heard) const {
  heard.landmarks = map_.size();
  heard.max_landmarks = as_size(settings_.max_landmarks);
  const Judgement judgement = judge(heard, health_);
  if (judgement.health != Health::tracking || !may_take_one_for_another()) return judgement;
  return {Health::degraded, "landmarks without names may be taken for each other, which is not noticed"};
}

/// Where position alone tells landmarks apart, a wrong association makes the next one more likely: the filter diverges
/// while its bearings agree with its map.
bool EkfEstimator::may_take_one_for_another() const {
  return !has_names() &&
         std::ranges::all_of(landmarks(), [](const Landmark& landmark) { return landmark.kind == kAnyKind; });
}

/// The gate is that of the innovation, S = H P H^T + R (mathematics I.6, I.7).
void EkfEstimator::expect(std::vector<ExpectedBearing>& out) const {
  const double sigmas = settings_.gates.chi2 > 0.0 ? std::sqrt(settings_.gates.chi2) : kUngatedSigmas;
  out.clear();
  for (const Landmark& landmark : landmarks())
    if (const auto predicted = view().predict_straight(landmark)) {
      const double sigma_rad = std::sqrt(predicted->variance_rad2 + predicted->row.variance);
      out.push_back({.landmark = landmark.id,
                     .kind = landmark.kind,
                     .azimuth_rad = predicted->azimuth_rad,
                     .gate_rad = sigmas * sigma_rad,
                     .sigma_rad = sigma_rad,
                     .rejected_in_row = landmark.rejected_in_row});
    }
}

void EkfEstimator::list_saved(StateSaver& saver) const {
  for (const Landmark& landmark : landmarks())
    if (landmark.confirmed && landmark.is_point())
      saver.add(
          landmark.block, BlockKind::point,
          {.id = landmark.id, .identity = landmark.identity, .kind = landmark.kind, .sightings = landmark.sightings});
}

bool EkfEstimator::save_map(MapSnapshot& out) const {
  if (!EkfOnMap::save_map(out)) return false;
  if (!names_) return true;
  for (const MapLandmark& landmark : out.landmarks) names_->identities().store().save(landmark.identity, out.views);
  out.next_identity = names_->identities().next();
  return true;
}

}  // namespace azimuth
