#include "slam/hindsight/smoother_estimator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/estimator/bearing_noise.hpp"
#include "slam/estimator/odometry_floors.hpp"
#include "slam/geometry/index.hpp"
#include "slam/hindsight/relocation.hpp"

namespace azimuth {
namespace {

constexpr double kNamedByAccident = 0.05;  // a wrong name that fits all the same
constexpr int kContradictionsInStreak = 5;
constexpr double kInnerView = 0.9;  // of the field of view: nearer to its rim nothing is expected
constexpr double kDrivenThrough_m = 0.5;
constexpr double kNearest_m = 0.05;  // landmarks at which a bearing says something
constexpr int kImagesBetweenBookmarks = 10;
constexpr Duration kLongestLag = std::chrono::seconds(2);
constexpr int kFitsAgain = 8, kMisfitCounts = 3;  // bearings

}  // namespace

SmootherEstimator::SmootherEstimator(const Rig& rig, const SmootherEstimatorSettings& settings,
                                     std::unique_ptr<Mapper> mapper, const MapStart& start)
    : rig_(rig), settings_(settings), mapper_(std::move(mapper)), lost_(settings.relocalisation) {
  set_bookmark();
  if (start.map == nullptr) return;
  start_ = *start.map;
  belief_.T_map_body = start_->T_map_body;
  beginning_.begin(start, [this](const StartPose& pose) { begin_at(pose); });
}

bool SmootherEstimator::odometry_begins(bool goes_on) {
  const bool here = beginning_.odometry_begins(goes_on, [this](const StartPose& pose) { begin_at(pose); });
  if (here) begin_at({.known = true, .moved = Eigen::Matrix3d::Zero(), .within = {}});
  return here;
}

/// On a map too small to be searched it begins from nothing: to go on would be to search for ever.
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
  hearing_.path_m += motion.path_m;
  const MovedPose moved = apply(belief_.T_map_body, motion);
  belief_ = {moved.T_map_body, moved.G * belief_.covariance * moved.G.transpose() + moved.noise};
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
  hearing_.troubles.add(bearings.trouble, hearing_.path_m);
  turn_to_body(bearings);
  if (settings_.named) rest_.add(image_, rig_.camera.sigma_bearing_rad, bearing_noise());
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
  for (const HeardBearing& bearing : mapper_->heard()) {
    if (bearing.agrees) {
      ++counts_.accepted;
      agreed = agreed || bearing.established;
      fit_since_slip_ += bearing.established && bearing.landmark_id < known_below_ ? 1 : 0;
    } else {
      ++counts_.rejected;
      ++hearing_.contradictions;
    }
  }
  if (agreed) hearing_.agreed();
  if (fit_since_slip_ >= kFitsAgain) slips_in_row_ = 0;
  hearing_.deaf_streaks = hearing_.contradictions / kContradictionsInStreak;
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
  std::vector<KnownLandmark> known;
  for (const HindsightLandmark& landmark : settled_landmarks()) {
    KnownLandmark& entry = known.emplace_back();
    const Eigen::Vector2d p = mapper_->smoother().graph().landmark(landmark.in_graph).p_map();
    entry.p_map_m = {p.x(), p.y(), std::numeric_limits<double>::quiet_NaN()};
    entry.covariance_m2.topLeftCorner<2, 2>() = mapper_->smoother().point_covariance(landmark.in_graph);
    entry.identity = landmark.identity;
  }
  CameraView view;
  view.field_of_view_rad = std::min(2.0 * kPi, rig_.camera.field_of_view_rad);
  view.yaw_rad = rig_.camera.yaw_offset_rad;
  view.detection_probability = settings_.relocalisation.detection_probability;
  lost_.begin_search(known, view, within);
  belief_.covariance = LostRobot::anywhere();
  fit_again_ = 0;
}

void SmootherEstimator::search() {
  if (fits_again()) return was_found();
  belief_.covariance = LostRobot::anywhere();
  const BearingGraph& graph = mapper_->smoother().graph();
  std::vector<SeenDirection> directions;
  for (const Bearing& bearing : image_.bearings) {
    SeenDirection& direction = directions.emplace_back();
    direction.azimuth_rad = wrap(bearing.azimuth_rad + graph.calibration()[calibration::yaw]);
    direction.sigma_rad = sigma_rad(bearing, rig_.camera);
    direction.identity = bearing.identity;
    direction.kind = bearing.kind;
  }
  const std::optional<PoseHypothesis> found = lost_.look(directions);
  if (!found) return;
  go_back_to({graph.body_at(found->T_map_body), kDoubtfulFactor * found->covariance});
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

}  // namespace azimuth
