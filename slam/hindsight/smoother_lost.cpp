// SmootherEstimator: a robot that is not where it should be.

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/estimator/bearing_noise.hpp"
#include "slam/geometry/index.hpp"
#include "slam/hindsight/relocation.hpp"
#include "slam/hindsight/smoother_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kNamedByAccident = 0.05;  // a wrong name that fits all the same
constexpr double kInnerView = 0.9;         // of the field of view: nearer to its rim nothing is expected
constexpr double kDrivenThrough_m = 0.5;
constexpr double kNearest_m = 0.05;  // landmarks at which a bearing says something
constexpr int kMisfitCounts = 3;     // bearings

}  // namespace

/// Who has seen things from one place only knows nothing of where they are.
bool SmootherEstimator::has_driven() const {
  return hearing_.path_m > kDrivenThrough_m || std::ranges::any_of(mapper_->landmarks(), &HindsightLandmark::recalled);
}

bool SmootherEstimator::can_be_lost() const { return has_driven() && count_settled() >= kFewestEstablished; }

/// What is seen meanwhile is of places that nobody knows the way to. A robot that is put where it is to begin begins
/// there.
void SmootherEstimator::lifted() {
  if (!lost_.is_searched_for() && !has_driven()) return go_back();
  if (!lost_.is_searched_for()) begin_search();
  belief_.covariance = LostRobot::anywhere();
}

/// What odometry says of the way here is void then; the image itself is left in the graph, where it fits nothing,
/// unless the robot was lost.
bool SmootherEstimator::relocate() {
  const std::optional<PoseGaussian> here = relocated(*mapper_, mapper_->pose(), known_below_, kNearest_m);
  if (!here) return false;
  if (lost_.is_searched_for()) {
    go_back_to(*here);
  } else {
    mapper_->place(*here);
    belief_ = mapper_->pose();
    was_found();
  }
  fit_since_slip_ = 0;
  if (++slips_in_row_ >= kSlipsUntilLost) begin_search();
  return true;
}

void SmootherEstimator::set_bookmark() {
  mapper_->bookmark();
  images_at_bookmark_ = image_poses_.size();
  images_since_bookmark_ = 0;
}

/// By the newest image as the whole graph explains it: odometry holds the pose where it was, so bearings from somewhere
/// else fit nowhere. In a room that is not on the map there are none that could, but others in their place. Those that
/// the graph leaves aside count as well: what was seen often enough from here has moved when the robot was lifted.
ImageAgreement SmootherEstimator::agreement() const {
  if (!settings_.named || !can_be_lost()) return {};
  ImageAgreement agreement{.chance = kNamedByAccident};
  for (const Bearing& bearing : image_.bearings) agreement.bearings += bearing.identity != kUnknownIdentity ? 1 : 0;
  for (const HindsightLandmark& landmark : mapper_->landmarks()) {
    if (landmark.id >= known_below_) continue;
    const auto bearing = std::ranges::find(image_.bearings, landmark.identity, &Bearing::identity);
    const bool is_shown = bearing != image_.bearings.end();
    const bool counts = is_settled(landmark) && (is_shown || names_seen_.is_due(landmark.identity, hearing_.path_m));
    const std::optional<Prediction> predicted = counts ? predict(landmark) : std::nullopt;
    if (is_shown && !predicted) --agreement.bearings;  // it says nothing of the pose
    if (!predicted || (!is_shown && !is_in_view(*predicted))) continue;
    ++agreement.expected;
    if (is_shown && agrees(*bearing, *predicted)) ++agreement.explained;
  }
  return agreement;
}

bool SmootherEstimator::is_in_view(const Prediction& predicted) const {
  const double azimuth_rad = wrap(predicted.azimuth_rad - rig_.camera.yaw_offset_rad);
  return std::abs(azimuth_rad) < kInnerView * 0.5 * rig_.camera.field_of_view_rad;
}

double SmootherEstimator::bearing_noise() const {
  const std::optional<RigBelief> rig = mapper_->rig();
  return rig ? rig->bearing_noise : 1.0;
}

bool SmootherEstimator::agrees(const Bearing& bearing, const Prediction& predicted) const {
  const double sigma = bearing_noise() * sigma_rad(bearing, rig_.camera);
  const double off_rad = wrap(bearing.azimuth_rad - predicted.azimuth_rad);
  return off_rad * off_rad < kFitsChi2 * (sigma * sigma + predicted.variance_rad2);
}

/// What an image shows that fits nowhere is no measure for those after it.
void SmootherEstimator::note_names() {
  if (lost_.is_searched_for() || lost_.is_in_doubt()) return names_seen_.pass_over();
  names_seen_.add(image_, hearing_.path_m);
  if (slips_in_row_ == 0) known_below_ = mapper_->next_id();
}

/// Mapping goes on meanwhile, since a burst of bad bearings looks the same: either they fit again, or the robot is
/// found somewhere else, and what was heard since it was carried off is forgotten.
void SmootherEstimator::begin_search(const std::optional<Whereabouts>& within) {
  lost_.begin_search(known(settled_landmarks()), view(), within);
  candidate_ = belief_;
  candidate_odds_ = 0.0;
  belief_.covariance = LostRobot::anywhere();
  fit_again_ = 0;
}

std::vector<KnownLandmark> SmootherEstimator::known(std::span<const HindsightLandmark> landmarks) const {
  std::vector<KnownLandmark> known;
  for (const HindsightLandmark& landmark : landmarks) {
    KnownLandmark& entry = known.emplace_back();
    const Eigen::Vector2d p = mapper_->smoother().graph().landmark(landmark.in_graph).p_map();
    entry.p_map_m = {p.x(), p.y(), std::numeric_limits<double>::quiet_NaN()};
    entry.covariance_m2.topLeftCorner<2, 2>() = covariances_.of(landmark, mapper_->smoother());
    entry.identity = landmark.identity;
    entry.kind = landmark.kind;
  }
  return known;
}

CameraView SmootherEstimator::view() const {
  CameraView view;
  view.field_of_view_rad = std::min(2.0 * kPi, rig_.camera.field_of_view_rad);
  view.yaw_rad = rig_.camera.yaw_offset_rad;
  view.detection_probability = settings_.relocalisation.detection_probability;
  if (const std::optional<Scene> scene = mapper_->scene()) {
    view.max_distance_m = scene->range_m;
    if (view.detection_probability <= 0.0) view.detection_probability = scene->detection_probability;
  }
  return view;
}

void SmootherEstimator::search() {
  if (fits_again()) return was_found();
  if (const auto here = look_for_robot()) go_back_to(*here);
}

/// Where it is; nothing: it may still be anywhere.
std::optional<PoseGaussian> SmootherEstimator::look_for_robot() {
  belief_.covariance = LostRobot::anywhere();
  const std::optional<PoseHypothesis> found = lost_.look(directions());
  if (!found) return std::nullopt;
  return PoseGaussian{mapper_->smoother().graph().body_at(found->T_map_body), kDoubtfulFactor * found->covariance};
}

/// Of the last image.
std::vector<SeenDirection> SmootherEstimator::directions() const {
  const double yaw_rad = mapper_->smoother().graph().calibration()[calibration::yaw];
  std::vector<SeenDirection> directions;
  for (const Bearing& bearing : image_.bearings) {
    SeenDirection& direction = directions.emplace_back();
    direction.azimuth_rad = wrap(bearing.azimuth_rad + yaw_rad);
    direction.sigma_rad = sigma_rad(bearing, rig_.camera);
    if (settings_.named) direction.identity = bearing.identity;
    direction.kind = bearing.kind;
  }
  return directions;
}

/// To path and map as they were at the bookmark.
void SmootherEstimator::go_back() {
  mapper_->return_to_bookmark();
  belief_ = mapper_->pose();
  image_poses_.truncate(images_at_bookmark_);
  image_poses_.add(image_.stamp, *mapper_);
  covariances_.forget();
}

/// Likewise, with the robot where it was found.
void SmootherEstimator::go_back_to(const PoseGaussian& here) {
  mapper_->return_to_bookmark();
  mapper_->place(here);
  belief_ = mapper_->pose();
  image_poses_.truncate(images_at_bookmark_);
  image_poses_.add(image_.stamp, *mapper_);
  was_found();
}

/// What the newest images show of the map is where it should be: more than chance or a few good bearings among bad ones
/// explain. What was mapped meanwhile fits itself, wherever that is.
bool SmootherEstimator::fits_again() {
  for (const HeardBearing& bearing : mapper_->heard())
    if (bearing.established && bearing.landmark_id < known_below_)
      fit_again_ = std::max(0, fit_again_ + (bearing.agrees ? 1 : -kMisfitCounts));
  return fit_again_ >= kFitsAgain;
}

void SmootherEstimator::was_found() {
  lost_.was_found();
  covariances_.forget();
  hearing_.agreed();
  ++counts_.recovered;
  set_bookmark();
}

}  // namespace azimuth
