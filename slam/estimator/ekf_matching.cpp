// EkfEstimator: which bearing belongs to which mapped landmark, and which pairings are believed.

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/estimator/bearing_noise.hpp"
#include "slam/estimator/ekf_estimator.hpp"

namespace azimuth {

bool EkfEstimator::repeats_a_name(const Bearing& bearing, const BearingSet& image) {
  const auto named_alike = [&](const Bearing& other) { return other.identity == bearing.identity; };
  return &*std::find_if(image.bearings.begin(), image.bearings.end(), named_alike) != &bearing;
}

void EkfEstimator::match_identities(const BearingSet& observations) {
  for (const Bearing& bearing : observations.bearings) {
    if (bearing.identity == kUnknownIdentity) continue;
    if (repeats_a_name(bearing, observations)) {
      ++counts_.rejected;
      continue;
    }
    const auto known = std::find_if(landmarks_.begin(), landmarks_.end(),
                                    [&](const Landmark& landmark) { return landmark.identity == bearing.identity; });
    if (known == landmarks_.end())
      unmapped_.push_back(bearing);
    else
      add_match(static_cast<std::size_t>(known - landmarks_.begin()), bearing, observations.stamp);
  }
}

void EkfEstimator::add_match(std::size_t at, const Bearing& bearing, Stamp stamp) {
  const Landmark& landmark = landmarks_[at];
  if (landmark.sightings > 0 && stamp - landmark.last_used < duration_from_seconds(settings_.thinning_s)) {
    ++counts_.thinned;
    return;
  }
  const MappedSighting sighting = sighting_of(landmark, bearing);
  const auto row = ekf_.linearise(sighting);
  if (!row) return;
  const double noise = sighting.variance_rad2 + ekf_.curvature_rad2(sighting);
  matches_.push_back({at, sighting, *row, ekf_.prediction_covariance(*row, *row) + noise});
}

/// Without identities a bearing belongs to the landmark that the likeliest joint hypothesis gives it, starts a new one
/// when that hypothesis says so, and is left alone when a rival hypothesis says otherwise.
void EkfEstimator::match_by_position(const BearingSet& observations) {
  measured_.clear();
  for (const Bearing& bearing : observations.bearings)
    measured_.push_back({bearing.azimuth_rad, variance_rad2(bearing), bearing.kind});
  predict_visible();
  const auto size = static_cast<Index>(visible_.size());
  const PredictedAzimuths predicted{visible_azimuths_rad_, innovation_covariance_.matrix(size, size), visible_kinds_};
  const JointGates gates{settings_.gate_chi2 > 0.0 ? settings_.gate_chi2 : 1e9,
                         settings_.joint_gate_probability > 0.0 ? settings_.joint_gate_probability : 0.9999,
                         new_density_per_rad_, settings_.rival_log_ratio};
  association_.associate(measured_, predicted, gates, pairings_);
  for (std::size_t i = 0; i < pairings_.size(); ++i) {
    const Bearing& bearing = observations.bearings[i];
    if (pairings_[i].landmark != kNoLandmark)
      add_match(visible_[static_cast<std::size_t>(pairings_[i].landmark)].landmark, bearing, observations.stamp);
    else if (pairings_[i].ambiguous)
      ++counts_.ambiguous;
    else
      unmapped_.push_back(bearing);
  }
}

/// How the camera should see a landmark now. How far from the image's centre is known from the last time, near enough
/// for the little the centre's error turns it.
std::optional<EkfEstimator::Visible> EkfEstimator::predict(std::size_t at) const {
  const Landmark& landmark = landmarks_[at];
  const auto row = ekf_.linearise(sighting_of(landmark, Bearing{}));
  if (!row) return std::nullopt;
  Bearing seen;
  seen.azimuth_rad = wrap(-row->innovation);
  seen.radius_px = landmark.radius_px;
  const auto centred = ekf_.linearise(sighting_of(landmark, seen));
  return Visible{at, *centred, wrap(seen.azimuth_rad - centred->innovation),
                 ekf_.prediction_covariance(*centred, *centred) + ekf_.curvature_rad2(sighting_of(landmark, seen))};
}

/// The landmarks within gate of some measured azimuth, with the joint covariance of their predicted azimuths.
void EkfEstimator::predict_visible() {
  visible_.clear();
  visible_azimuths_rad_.clear();
  visible_kinds_.clear();
  const double gate = settings_.gate_chi2 > 0.0 ? settings_.gate_chi2 : 1e9;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const std::optional<Visible> visible = predict(i);
    if (!visible) continue;
    const bool expected = std::any_of(measured_.begin(), measured_.end(), [&](const MeasuredAzimuth& measured) {
      const double innovation = wrap(measured.azimuth_rad - visible->azimuth_rad);
      return same_kind(measured.kind, landmarks_[i].kind) &&
             innovation * innovation < gate * (visible->variance_rad2 + measured.variance_rad2);
    });
    if (!expected) continue;
    visible_.push_back(*visible);
    visible_azimuths_rad_.push_back(visible->azimuth_rad);
    visible_kinds_.push_back(landmarks_[i].kind);
  }
  const auto size = static_cast<Index>(visible_.size());
  auto covariance = innovation_covariance_.matrix(size, size);
  for (Index r = 0; r < size; ++r) {
    const Visible& a = visible_[static_cast<std::size_t>(r)];
    for (Index c = 0; c < r; ++c)
      covariance(r, c) = covariance(c, r) =
          ekf_.prediction_covariance(a.row, visible_[static_cast<std::size_t>(c)].row);
    covariance(r, r) = a.variance_rad2;
  }
}

void EkfEstimator::gate_individually() {
  if (settings_.gate_chi2 <= 0.0) return;
  for (Match& match : matches_)
    match.accepted = match.row.innovation * match.row.innovation < settings_.gate_chi2 * match.variance;
}

void EkfEstimator::gate_jointly() {
  if (settings_.joint_gate_probability <= 0.0) return;
  gated_.clear();
  innovations_.clear();
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    if (!matches_[i].accepted) continue;
    gated_.push_back(i);
    innovations_.push_back(matches_[i].row.innovation);
  }
  const auto size = static_cast<Index>(gated_.size());
  if (size < 2) return;
  auto S = innovation_covariance_.matrix(size, size);
  for (Index r = 0; r < size; ++r)
    for (Index c = 0; c <= r; ++c) {
      const Match& a = matches_[gated_[static_cast<std::size_t>(r)]];
      const Match& b = matches_[gated_[static_cast<std::size_t>(c)]];
      S(r, c) = S(c, r) = r == c ? a.variance : ekf_.prediction_covariance(a.row, b.row);
    }
  joint_test_.prune(innovations_, S, settings_.joint_gate_probability, jointly_accepted_);
  for (std::size_t i = 0; i < gated_.size(); ++i) matches_[gated_[i]].accepted = jointly_accepted_[i] != 0;
}

}  // namespace azimuth
