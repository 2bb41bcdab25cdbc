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
constexpr double kNearest_m = 0.05;  // landmarks at which a bearing says something
constexpr int kImagesBetweenBookmarks = 10;
constexpr Duration kLongestLag = std::chrono::seconds(2);
constexpr int kFitsAgain = 8, kMisfitCounts = 3;  // bearings

}  // namespace

SmootherEstimator::SmootherEstimator(const Rig& rig, const SmootherEstimatorSettings& settings,
                                     std::unique_ptr<Mapper> mapper, const MapStart& start)
    : rig_(rig), settings_(settings), mapper_(std::move(mapper)), lost_(settings.relocalisation) {
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
  set_bookmark();
  if (!pose.known) begin_search(pose.within);
}

void SmootherEstimator::predict(const Motion& motion) {
  mapper_->predict(motion);
  lost_.predict(with_floors(motion, rig_.odometry));
  hearing_.path_m += motion.path_m;
  const MovedPose moved = apply(belief_.T_map_body, motion);
  belief_ = {moved.T_map_body, moved.G * belief_.covariance * moved.G.transpose() + moved.noise};
}

void SmootherEstimator::update(const BearingSet& bearings) {
  hear(bearings);
  const std::vector<HindsightLandmark> settled = settled_landmarks();
  covariances_.refresh(settled, mapper_->smoother());
  map_reach_m_ = 0.0;
  for (const HindsightLandmark& landmark : settled)
    map_reach_m_ = std::max(map_reach_m_, mapper_->smoother().graph().landmark(landmark.in_graph).p_map().norm());
}

void SmootherEstimator::hear(const BearingSet& bearings) {
  hearing_.troubles.add(bearings.trouble, hearing_.path_m);
  turn_to_body(bearings);
  const UpdateOutcome heard = mapper_->update(image_);
  listen(heard);
  belief_ = mapper_->pose();
  image_poses_.add(image_.stamp, *mapper_);
  latest_.push_back({image_.stamp, belief_.T_map_body});
  while (latest_.size() > 2 && latest_[1].stamp <= image_.stamp - kLongestLag) latest_.pop_front();
  if (!heard.used && !lost_.is_searched_for()) return;
  if (settings_.named && relocate()) return;
  const ImageAgreement agreed = agreement();
  if (lost_.is_searched_for())
    search(agreed);
  else if (lost_.notices(agreed))
    begin_search();
  else if (lost_.is_certain() && ++images_since_bookmark_ >= kImagesBetweenBookmarks)
    set_bookmark();
}

/// What odometry says of the way here is void then; the image itself is left in the graph, where it fits nothing.
bool SmootherEstimator::relocate() {
  const std::optional<PoseGaussian> here = relocated(*mapper_, mapper_->pose(), kNearest_m);
  if (!here) return false;
  mapper_->place(*here);
  belief_ = mapper_->pose();
  was_found();
  ++slips_in_row_;
  fit_since_slip_ = 0;
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
      fit_since_slip_ += bearing.established ? 1 : 0;
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
/// else fit nowhere.
ImageAgreement SmootherEstimator::agreement() const {
  if (!settings_.named || count_settled() < kFewestEstablished) return {};
  ImageAgreement agreement{.chance = kNamedByAccident};
  for (const HeardBearing& bearing : mapper_->heard()) {
    if (!bearing.established) continue;
    ++agreement.expected;
    ++agreement.bearings;
    agreement.explained += bearing.agrees ? 1 : 0;
  }
  return agreement;
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

void SmootherEstimator::search(const ImageAgreement& agreed) {
  if (fits_again(agreed)) return was_found();
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
  const Pose2 T_map_body = graph.body_at(found->T_map_body);
  mapper_->return_to_bookmark();
  mapper_->place({T_map_body, kDoubtfulFactor * found->covariance});
  belief_ = mapper_->pose();
  image_poses_.truncate(images_at_bookmark_);
  image_poses_.add(image_.stamp, *mapper_);
  was_found();
}

/// What the newest images show is where it should be: more than chance or a few good bearings among bad ones explain.
bool SmootherEstimator::fits_again(const ImageAgreement& agreed) {
  const int misfits = agreed.bearings - agreed.explained;
  fit_again_ = std::max(0, fit_again_ + agreed.explained - kMisfitCounts * misfits);
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
