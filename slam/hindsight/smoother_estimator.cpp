#include "slam/hindsight/smoother_estimator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "slam/estimator/rig_noise.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr int kContradictionsInStreak = 5;
constexpr int kImagesBetweenBookmarks = 10;
constexpr Duration kLongestLag = std::chrono::seconds(2);

}  // namespace

SmootherEstimator::SmootherEstimator(const Rig& rig, const SmootherEstimatorSettings& settings,
                                     std::unique_ptr<Mapper> mapper, const MapStart& start)
    : rig_(rig),
      settings_(settings),
      mapper_(std::move(mapper)),
      lost_(settings.relocalisation),
      rest_(settings.named),
      match_(settings.relocalisation) {
  set_bookmark();
  if (start.map == nullptr) return;
  start_ = *start.map;
  belief_.T_map_body = start_->T_map_body;
  start_decision_.begin(start, [this](const StartPose& pose) { begin_at(pose); });
}

bool SmootherEstimator::odometry_begins(bool goes_on) {
  const bool here = start_decision_.odometry_begins(goes_on, [this](const StartPose& pose) { begin_at(pose); });
  if (here) begin_at({.known = true, .moved = Eigen::Matrix3d::Zero(), .within = {}});
  return here;
}

/// Starts from the saved map. If the pose is unknown and the map is too small for relocalisation, it starts from an
/// empty map, since relocalisation would never end.
void SmootherEstimator::begin_at(const StartPose& pose) {
  const MapSnapshot map = *std::exchange(start_, std::nullopt);
  const bool searchable = settings_.named && map.landmarks.size() >= kFewestEstablished;
  belief_ = {};
  if (!pose.known && !searchable) return;
  if (!mapper_->remember(map, pose.known ? std::optional(pose.moved) : std::nullopt)) return;
  belief_ = mapper_->pose();
  known_below_ = mapper_->next_id();
  set_bookmark();
  if (!pose.known) begin_search(pose.within);
}

void SmootherEstimator::predict(const Motion& motion) {
  mapper_->predict(motion);
  rest_.predict(motion);
  lost_.predict(with_floors(motion, rig_.odometry));
  recognition_.path_m += motion.path_m;
  belief_ = moved(belief_, motion);
  candidate_ = moved(candidate_, motion);
}

void SmootherEstimator::update(const BearingSet& bearings) {
  hear(bearings);
  if (settings_.named) note_names();
  const std::vector<HindsightLandmark> settled = settled_landmarks();
  covariances_.refresh(settled, mapper_->smoother());
  map_reach_m_ = 0.0;
  for (const HindsightLandmark& landmark : settled)
    map_reach_m_ = std::max(map_reach_m_, mapper_->smoother().graph().landmark(landmark.in_graph).p_map().norm());
}

void SmootherEstimator::hear(const BearingSet& bearings) {
  recognition_.troubles.add(bearings.trouble, recognition_.path_m);
  turn_to_body(bearings);
  rest_.add(image_, rig_.camera.sigma_bearing_rad, bearing_noise());
  // Without identities the bookmark cannot be restored, so bearings of a robot that is elsewhere are not used at all.
  const bool is_carried_off = !settings_.named && rest_.is_carried() && can_be_lost();
  held_back_ = is_carried_off || (!settings_.named && is_held_back());
  if (is_carried_off) return lifted();
  if (held_back_) return;
  const bool is_lifted = rest_.is_carried() && (can_be_lost() || !has_driven());
  if (is_lifted) image_.bearings.clear();
  const UpdateOutcome heard = mapper_->update(image_);
  listen(heard);
  belief_ = mapper_->pose();
  image_poses_.add(image_.stamp, *mapper_);
  latest_.push_back({image_.stamp, belief_.T_map_body});
  while (latest_.size() > 2 && latest_[1].stamp <= image_.stamp - kLongestLag) latest_.pop_front();
  if (is_lifted) return lifted();
  if (settings_.named && relocate()) return;
  if (lost_.is_searched_for()) return search();
  const ImageAgreement agreed = agreement();
  if (!heard.used && agreed.bearings == 0) return;
  if (lost_.notices(agreed))
    begin_search();
  else if (lost_.is_certain() && has_driven() && ++images_since_bookmark_ >= kImagesBetweenBookmarks)
    set_bookmark();
}

void SmootherEstimator::turn_to_body(const BearingSet& image) {
  image_.stamp = image.stamp;
  image_.sequence = image.sequence;
  image_.bearings = image.bearings;
  for (Bearing& bearing : image_.bearings) bearing.azimuth_rad = wrap(bearing.azimuth_rad + rig_.camera.yaw_offset_rad);
}

void SmootherEstimator::listen(const UpdateOutcome& heard) {
  counts_.created += heard.created;
  counts_.deleted += heard.deleted;
  counts_.thinned += heard.thinned;
  counts_.ambiguous += heard.ambiguous;
  counts_.recovered += heard.recovered;
  bool agreed = false;
  for (const UsedBearing& bearing : mapper_->heard()) {
    if (bearing.agrees) {
      ++counts_.accepted;
      agreed = agreed || bearing.established;
      fit_since_slip_ += bearing.established && bearing.landmark_id < known_below_ ? 1 : 0;
    } else {
      ++counts_.rejected;
      ++recognition_.contradictions;
    }
  }
  if (agreed) recognition_.agreed();
  if (fit_since_slip_ >= kFitsAgain) slips_in_row_ = 0;
  recognition_.inflations = recognition_.contradictions / kContradictionsInStreak;
}

bool SmootherEstimator::is_settled(const HindsightLandmark& landmark) const {
  return mapper_->smoother().graph().landmark(landmark.in_graph).is_point() &&
         (landmark.recalled || landmark.sightings >= as_size(settings_.confirm_after_bearings));
}

std::size_t SmootherEstimator::count_settled() const {
  return as_size(
      std::ranges::count_if(mapper_->landmarks(), [this](const auto& landmark) { return is_settled(landmark); }));
}

std::vector<HindsightLandmark> SmootherEstimator::settled_landmarks() const {
  std::vector<HindsightLandmark> settled;
  for (const HindsightLandmark& landmark : mapper_->landmarks())
    if (is_settled(landmark)) settled.push_back(landmark);
  return settled;
}

void LandmarkCovariances::refresh(std::span<const HindsightLandmark> landmarks, const Smoother& smoother) {
  if (landmarks.size() <= kEachTime) return forget();
  for (std::size_t i = 0; i < kEachTime; ++i, ++next_) {
    if (next_ >= landmarks.size()) next_ = 0;
    const HindsightLandmark& landmark = landmarks[next_];
    kept_[landmark.id] = {landmark.in_graph, smoother.point_covariance(landmark.in_graph)};
  }
}

Eigen::Matrix2d LandmarkCovariances::of(const HindsightLandmark& landmark, const Smoother& smoother) const {
  const auto kept = kept_.find(landmark.id);
  const bool is_it = kept != kept_.end() && kept->second.in_graph == landmark.in_graph;
  return is_it ? kept->second.covariance_m2 : smoother.point_covariance(landmark.in_graph);
}

}  // namespace azimuth
