// EkfEstimator: how it notices that the robot is lost, and finds it again.

#include <algorithm>
#include <cmath>

#include "slam/estimator/bearing_noise.hpp"
#include "slam/estimator/ekf_estimator.hpp"
#include "slam/estimator/lost_robot.hpp"

namespace azimuth {
namespace {

constexpr double kMoment_m = 1.5;  // driven: what was seen then should be seen still
constexpr double kGate_sigmas = 3.0;
constexpr double kInnerView = 0.9;  // of the field of view: nearer to its rim nothing is expected
constexpr double kNamedByAccident = 0.05;
constexpr double kSlackRange = 1.25;  // beyond the farthest landmark seen lately
constexpr std::size_t kFewestToPlace = 4;

/// By its name.
bool shows(const BearingSet& image, const EkfEstimator::Landmark& landmark) {
  return std::ranges::find(image.bearings, landmark.identity, &Bearing::identity) != image.bearings.end();
}

}  // namespace

/// Which of a saved map's landmarks were in view when it was saved nobody knows: one that is not in the image need not
/// be, one that is has to be where it should. Where there are no names it cannot be told whether it is.
bool EkfEstimator::was_seen_lately(const Landmark& landmark, const BearingSet& image) const {
  if (landmark.recalled && has_names()) return shows(image, landmark);
  return path_m_ - landmark.last_used_m < kMoment_m;
}

/// What was seen a moment ago and is in view still, and how much of the image is where it should be.
ImageAgreement EkfEstimator::agreement(const BearingSet& observations) {
  // Among things in the plane that all look alike, and are not where they should be, a search finds wrong places.
  const auto alike = [](const Bearing& bearing) { return bearing.kind == kAnyKind; };
  if (!has_names() && std::ranges::all_of(observations.bearings, alike)) return {};
  ImageAgreement agreement{.bearings = static_cast<int>(observations.bearings.size())};
  explained_.assign(observations.bearings.size(), 0);
  std::size_t established = 0;
  double width_rad = 0.0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[i];
    if (landmark.sightings < static_cast<std::uint64_t>(settings_.confirm_after_sightings)) continue;
    if (landmark.block_kind == BlockKind::point) ++established;
    const bool lately = was_seen_lately(landmark, observations);
    if (!lately && has_names() && !shows(observations, landmark)) continue;
    const auto visible = predict(i);
    if (!visible) continue;
    const double variance_rad2 = visible->variance_rad2 + visible->row.variance;
    const double gate_rad = kGate_sigmas * std::sqrt(variance_rad2);
    const bool in_view = std::abs(visible->azimuth_rad) < kInnerView * 0.5 * rig_.camera.field_of_view_rad;
    if (in_view && lately) {
      ++agreement.expected;
      width_rad += 2.0 * gate_rad;
    }
    for (std::size_t b = 0; b < explained_.size(); ++b) {
      const Bearing& bearing = observations.bearings[b];
      if (has_names() ? bearing.identity != landmark.identity : !same_kind(bearing.kind, landmark.kind)) continue;
      if (std::abs(wrap(bearing.azimuth_rad - visible->azimuth_rad)) < gate_rad) explained_[b] = 1;
    }
  }
  if (established < kFewestEstablished) return {};
  agreement.explained = static_cast<int>(std::ranges::count(explained_, 1));
  agreement.chance =
      has_names() ? kNamedByAccident : 1.0 - std::exp(-width_rad / std::min(2.0 * kPi, rig_.camera.field_of_view_rad));
  return agreement;
}

CameraView EkfEstimator::camera_view() const {
  CameraView view;
  view.yaw_rad = ekf_.yaw_offset_rad();
  view.field_of_view_rad = std::min(2.0 * kPi, rig_.camera.field_of_view_rad);
  view.detection_probability = settings_.relocalisation.detection_probability;
  view.max_distance_m = settings_.max_viewing_distance_m;
  if (seen_range_m_ > 0.0) view.max_distance_m = std::min(view.max_distance_m, kSlackRange * seen_range_m_);
  return view;
}

/// The map is left as it is until the robot is found in it.
void EkfEstimator::begin_search(const std::optional<Whereabouts>& within) {
  std::vector<KnownLandmark> known;
  for (const Landmark& landmark : landmarks_) {
    if (landmark.block_kind != BlockKind::point) continue;
    KnownLandmark& entry = known.emplace_back();
    const Eigen::Vector2d p = ekf_.state().position(landmark.block);
    entry.p_map_m = {p.x(), p.y(), std::numeric_limits<double>::quiet_NaN()};
    entry.covariance_m2.topLeftCorner<2, 2>() = ekf_.state().position_covariance(landmark.block);
    entry.identity = landmark.identity;
    entry.kind = landmark.kind;
  }
  if (!relocaliser_) relocaliser_.emplace(settings_.relocalisation);
  relocaliser_->start(known, camera_view(), within);
  const Eigen::Vector3d anywhere(kAnywhere_m, kAnywhere_m, kPi);
  ekf_.place_robot(ekf_.state().pose(), anywhere.cwiseAbs2().asDiagonal());
  watch_.settle();
  searching_ = true;
}

void EkfEstimator::search(const BearingSet& observations) {
  if (relocate(observations)) return;
  directions_.clear();
  for (const Bearing& bearing : observations.bearings) {
    const Sighting seen = ekf_.sighting_from(JointState::kPose, bearing.azimuth_rad, bearing.radius_px);
    SeenDirection& direction = directions_.emplace_back();
    direction.azimuth_rad = wrap(seen.azimuth_rad);
    direction.sigma_rad = sigma_rad(bearing, rig_.camera);
    direction.identity = bearing.identity;
    direction.kind = bearing.kind;
  }
  // Names of ours that are new stand for nothing in the map, and would be most of the directions.
  if (identities_)
    std::erase_if(directions_, [&](const SeenDirection& direction) {
      return std::ranges::find(landmarks_, direction.identity, &Landmark::identity) == landmarks_.end();
    });
  relocaliser_->update(directions_);
  if (const auto found = relocaliser_->found()) settle_at(*found, observations);
}

/// The pose becomes a function of what the last image shows, correlated with the map as it should be, when that image
/// is enough for it.
void EkfEstimator::settle_at(const PoseHypothesis& found, const BearingSet& observations) {
  ekf_.place_robot(found.T_map_body, kDoubtfulFactor * found.covariance);
  pair_from_here(observations);
  std::optional<Resection> seen;
  if (named_.size() >= kFewestToPlace) seen = ekf_.resect(named_);
  if (seen) {
    const Pose2 off = inverse(found.T_map_body) * seen->T_map_body;
    if (off.position().norm() < kNear_m && std::abs(off.heading_rad) < kNear_rad) ekf_.relocate(named_, *seen);
  }
  ++counts_.recovered;
  was_found();
}

/// Bearings that are of one landmark and of no other.
void EkfEstimator::pair_from_here(const BearingSet& observations) {
  named_.clear();
  named_landmarks_.clear();
  measured_.clear();
  for (const Bearing& bearing : observations.bearings)
    measured_.push_back({bearing.azimuth_rad, variance_rad2(bearing), bearing.kind});
  predict_visible();
  for (const Bearing& bearing : observations.bearings) {
    std::size_t candidates = 0, only = 0;
    for (const Visible& visible : visible_) {
      const Landmark& landmark = landmarks_[visible.landmark];
      const double variance = visible.variance_rad2 + variance_rad2(bearing);
      const double innovation = wrap(bearing.azimuth_rad - visible.azimuth_rad);
      const bool named_otherwise = has_names() && bearing.identity != landmark.identity;
      if (named_otherwise || !same_kind(bearing.kind, landmark.kind) || landmark.block_kind != BlockKind::point ||
          innovation * innovation > kGate_sigmas * kGate_sigmas * variance)
        continue;
      ++candidates;
      only = visible.landmark;
    }
    if (candidates != 1 || std::ranges::find(named_landmarks_, only) != named_landmarks_.end()) continue;
    named_.push_back(sighting_of(landmarks_[only], bearing));
    named_landmarks_.push_back(only);
  }
}

void EkfEstimator::was_found() {
  searching_ = false;
  watch_.settle();
  deaf_sightings_ = deaf_streaks_ = 0;
  last_accepted_m_ = path_m_;
}

std::string_view EkfEstimator::why_lost() const {
  if (relocaliser_->is_ambiguous()) return "several places on the map look alike";
  return "none of the landmarks is where it should be";
}

}  // namespace azimuth
