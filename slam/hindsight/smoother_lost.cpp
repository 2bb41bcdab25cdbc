// SmootherEstimator: detection that the robot is not where the estimator believes, and relocalisation.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/resection.hpp"
#include "slam/estimator/rig_noise.hpp"
#include "slam/geometry/index.hpp"
#include "slam/hindsight/smoother_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kNamedByAccident = 0.05;  // probability that a wrong identity fits
constexpr double kInnerView = 0.9;         // share of the field of view within which landmarks are expected
constexpr double kDrivenThrough_m = 0.5;
constexpr double kNearest_m = 0.05;  // least distance of a landmark whose bearing is used
constexpr int kMisfitCounts = 3;     // a misfit counts as so many fitting bearings

constexpr std::size_t kFewest = 5;          // bearings; any three fit some pose
constexpr std::size_t kContradictions = 3;  // fewer contradictions speak against landmarks rather than the pose
constexpr int kUnknowns = 3;
// Upper bound of a chi-square with as many degrees of freedom as there are bearings beyond the unknowns: the mean plus
// three standard deviations.
double gate(std::size_t bearings) {
  const double freedom = static_cast<double>(bearings) - kUnknowns;
  return freedom + 3.0 * std::sqrt(2.0 * freedom);
}
constexpr double kRivalFactor = 2.0;       // a rival pose must exceed the gate by this factor
constexpr double kContradictsChi2 = 30.0;  // 3 degrees of freedom; beyond it, two poses contradict each other

bool counts(const UsedBearing& bearing, std::int64_t known_below) {
  return bearing.established && bearing.landmark_id < known_below;
}

bool is_contradicted(std::span<const UsedBearing> heard, std::int64_t known_below) {
  std::size_t established = 0, misfits = 0;
  for (const UsedBearing& bearing : heard) {
    if (!counts(bearing, known_below)) continue;
    ++established;
    misfits += bearing.agrees ? 0 : 1;
  }
  return established >= kFewest && misfits >= kContradictions && 2 * misfits > established;
}

std::optional<Resection> resection(const Mapper& mapper, std::int64_t known_below, double min_distance_m,
                                   std::size_t& bearings) {
  const Smoother& smoother = mapper.smoother();
  std::vector<DirectionTo> directions;
  std::vector<Smoother::Unknown> unknowns;
  double variance_rad2 = 0.0;
  for (const UsedBearing& bearing : mapper.heard()) {
    if (!counts(bearing, known_below)) continue;
    const auto of = std::ranges::find(mapper.landmarks(), bearing.landmark_id, &HindsightLandmark::id);
    if (of == mapper.landmarks().end() || !smoother.graph().landmark(of->in_graph).is_point()) continue;
    directions.push_back({smoother.graph().landmark(of->in_graph).p_map(),
                          wrap(bearing.azimuth_rad + smoother.graph().calibration()[calibration::yaw])});
    unknowns.emplace_back(Smoother::LandmarkOf{of->in_graph});
    variance_rad2 = std::max(variance_rad2, bearing.sigma_rad * bearing.sigma_rad);
  }
  bearings = directions.size();
  if (bearings < kFewest) return std::nullopt;
  const Eigen::MatrixXd in_chart = smoother.covariance(unknowns);
  Eigen::MatrixXd to_map = Eigen::MatrixXd::Zero(in_chart.rows(), in_chart.cols());
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    to_map.block<2, 2>(2 * as_index(i), 2 * as_index(i)) =
        smoother.graph().landmark(std::get<Smoother::LandmarkOf>(unknowns[i]).id).p_by_chart();
  return resect(directions, to_map * in_chart * to_map.transpose(), variance_rad2, min_distance_m);
}

/// Relocalisation from one image with identities, for instance after the wheels have slipped. Returns a pose when most
/// of the image contradicts the believed pose and exactly one other pose explains it; otherwise empty.
///
/// Only landmarks with ids below `known_below` are used. `belief` is the pose and its covariance of (x [m], y [m],
/// heading [rad]) in the map. Thread contract: reentrant.
std::optional<PoseGaussian> relocated(const Mapper& mapper, const PoseGaussian& belief, std::int64_t known_below,
                                      double min_distance_m) {
  if (!is_contradicted(mapper.heard(), known_below)) return std::nullopt;
  std::size_t bearings = 0;
  const std::optional<Resection> found = resection(mapper, known_below, min_distance_m, bearings);
  if (!found || found->chi2 > gate(bearings) || found->rival_chi2 < kRivalFactor * gate(bearings)) return std::nullopt;
  const Pose2 T_map_body = mapper.smoother().graph().body_at(found->T_map_body);
  Eigen::Vector3d apart = T_map_body.vector() - belief.T_map_body.vector();
  apart.z() = wrap(apart.z());
  const Eigen::Matrix3d P = belief.covariance + found->covariance;
  if (apart.dot(P.ldlt().solve(apart)) < kContradictsChi2) return std::nullopt;
  return PoseGaussian{T_map_body, found->covariance};
}

}  // namespace

/// Whether landmark positions are known: the robot has driven, or there is a saved map. From one place, bearings do not
/// determine positions.
bool SmootherEstimator::has_driven() const {
  return recognition_.path_m > kDrivenThrough_m ||
         std::ranges::any_of(mapper_->landmarks(), &HindsightLandmark::recalled);
}

bool SmootherEstimator::can_be_lost() const { return has_driven() && count_settled() >= kFewestEstablished; }

/// Handles a robot that was lifted. The bearings since the lift are from places without known connection to the map, so
/// the robot is relocalised. A robot that was moved before it had driven starts anew where it is put down.
void SmootherEstimator::lifted() {
  if (!lost_.is_searched_for() && !has_driven()) return go_back();
  if (!lost_.is_searched_for()) begin_search();
  belief_.covariance = LostRobot::anywhere();
}

/// Relocalises the robot from the last image. The odometry to this image is discarded. The image stays in the graph,
/// where its bearings fit nothing, unless the robot was lost.
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

/// How well the newest image fits the graph. Odometry holds the pose where it was, so bearings from elsewhere do not
/// fit. An unmapped room shows unmapped landmarks instead of mapped ones, so a landmark that is due but not shown
/// counts as unexplained. Bearings that the graph thins out count too: the landmarks have moved when the robot was
/// lifted.
ImageAgreement SmootherEstimator::agreement() const {
  if (!settings_.named || !can_be_lost()) return {};
  ImageAgreement agreement{.chance = kNamedByAccident};
  for (const Bearing& bearing : image_.bearings) agreement.bearings += bearing.identity != kUnknownIdentity ? 1 : 0;
  for (const HindsightLandmark& landmark : mapper_->landmarks()) {
    if (landmark.id >= known_below_) continue;
    const auto bearing = std::ranges::find(image_.bearings, landmark.identity, &Bearing::identity);
    const bool is_shown = bearing != image_.bearings.end();
    const bool counts =
        is_settled(landmark) && (is_shown || names_seen_.is_due(landmark.identity, recognition_.path_m));
    const std::optional<Prediction> predicted = counts ? predict(landmark) : std::nullopt;
    if (is_shown && !predicted) --agreement.bearings;  // the bearing carries no information on the pose
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

/// Remembers the image's identities. An image that does not fit must not be the reference for later images.
void SmootherEstimator::note_names() {
  if (lost_.is_searched_for() || lost_.is_in_doubt()) return names_seen_.pass_over();
  names_seen_.add(image_, recognition_.path_m);
  if (slips_in_row_ == 0) known_below_ = mapper_->next_id();
}

/// Starts relocalisation. Mapping continues, since a burst of bad bearings looks the same: either bearings fit again,
/// or the robot is found elsewhere and everything since the bookmark is discarded.
void SmootherEstimator::begin_search(const std::optional<PositionPrior>& within) {
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

/// Returns the robot's pose, or nothing while it is not determined.
std::optional<PoseGaussian> SmootherEstimator::look_for_robot() {
  belief_.covariance = LostRobot::anywhere();
  const std::optional<PoseHypothesis> found = lost_.look(directions());
  if (!found) return std::nullopt;
  return PoseGaussian{mapper_->smoother().graph().body_at(found->T_map_body), kDoubtfulFactor * found->covariance};
}

/// Directions of the last image.
std::vector<SeenDirection> SmootherEstimator::directions() const {
  const double yaw_rad = mapper_->calibration()[calibration::yaw];
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

/// Restores path and map as of the bookmark.
void SmootherEstimator::go_back() {
  mapper_->return_to_bookmark();
  belief_ = mapper_->pose();
  image_poses_.truncate(images_at_bookmark_);
  image_poses_.add(image_.stamp, *mapper_);
  covariances_.forget();
}

/// Restores path and map as of the bookmark, with the robot at the pose found.
void SmootherEstimator::go_back_to(const PoseGaussian& here) {
  mapper_->return_to_bookmark();
  mapper_->place(here);
  belief_ = mapper_->pose();
  image_poses_.truncate(images_at_bookmark_);
  image_poses_.add(image_.stamp, *mapper_);
  was_found();
}

/// Whether the newest images fit the map again, by more bearings than chance explains. Landmarks mapped since the doubt
/// began do not count, since they fit wherever the robot is.
bool SmootherEstimator::fits_again() {
  for (const UsedBearing& bearing : mapper_->heard())
    if (bearing.established && bearing.landmark_id < known_below_)
      fit_again_ = std::max(0, fit_again_ + (bearing.agrees ? 1 : -kMisfitCounts));
  return fit_again_ >= kFitsAgain;
}

void SmootherEstimator::was_found() {
  lost_.was_found();
  covariances_.forget();
  recognition_.agreed();
  ++counts_.recovered;
  set_bookmark();
}

}  // namespace azimuth
