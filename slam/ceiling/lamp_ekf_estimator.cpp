#include "slam/ceiling/lamp_ekf_estimator.hpp"

#include <algorithm>
#include <cmath>

#include "slam/camera/make_camera.hpp"
#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "slam/estimator/rig_noise.hpp"
#include "slam/estimator/second_start.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

// Lamps that must be expected before their absence says anything about the pose
constexpr std::size_t kFewestExpected = 3;
constexpr int kMostDoubts = 5;  // Upper bound on doubts_
// With so many matched lamps, one image determines the pose better than the relocalisation
constexpr std::size_t kFewestLampsToPlace = 3;

LampEkfModel filter_model(const Rig& rig, const LampEkfSettings& settings, const std::optional<Restart>& again = {}) {
  LampEkfModel model;
  model.retraction = settings.invariant_update ? JointState::Retraction::invariant : JointState::Retraction::additive;
  model.camera_height_m = rig.camera.image.viewpoint_height_m.value_or(kUnknownHeight_m);
  model.min_height_m = settings.height.least_m;
  if (rig.front_end != FrontEnd::bearings && LampDirections(rig).camera()) {
    model.sigma_centre_px = settings.centre.sigma_px;
    model.sigma_tilt_rad = sigma_tilt_rad(rig.camera);
  }
  model.sigma_considered = sigma_considered(rig);
  if (again) {
    model.camera_errors = again->camera_errors;
    model.sigma_centre_px = again->sigma_centre_px;
  }
  return model;
}

/// Converts a measured direction to the form of a relocalisation.
SeenDirection seen_direction(const MeasuredDirection& measured) {
  const Eigen::Vector2d m = measured.seen.offset_per_metre();
  const double zenith_rad = std::atan(m.norm());
  return {.azimuth_rad = std::atan2(m.y(), m.x()),
          .sigma_rad = std::sqrt(measured.seen.variance().x()) / std::sin(zenith_rad),
          .elevation_rad = kPi / 2.0 - zenith_rad,
          .sigma_elevation_rad = std::sqrt(measured.seen.variance().y()),
          .identity = measured.identity};
}

}  // namespace

LampEkfEstimator::LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const std::optional<Restart>& again,
                                   const HealthSettings& health, const RelocalisationSettings& relocalisation)
    : EkfOnMap(rig, LampEkf(filter_model(rig, settings, again)),
               LampMap(settings, {rig, settings.view}, again ? again->height : std::nullopt), health, relocalisation),
      settings_(settings),
      view_(rig, settings.view),
      matcher_(settings, view_) {
  for (auto* list : {&accepted_, &doubtful_}) list->reserve(kTypicalLandmarks);
  lamps_of_bearings_.reserve(kTypicalLandmarks);
  directions_seen_.reserve(kTypicalLandmarks);
}

LampEkfEstimator::LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const MapStart& start,
                                   const HealthSettings& health, const RelocalisationSettings& relocalisation)
    : LampEkfEstimator(rig, settings, std::optional<Restart>(), health, relocalisation) {
  if (start.map != nullptr) begin_on(start);
}

LampEkfEstimator::LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const Restart& again,
                                   const HealthSettings& health, const RelocalisationSettings& relocalisation)
    : LampEkfEstimator(rig, settings, std::optional(again), health, relocalisation) {
  map_.continue_from(again.next_id);
}

void LampEkfEstimator::begin_at(const StartPose& pose) {
  if (pose.known || map_.empty())
    ekf_.inflate_robot(pose.moved);
  else
    begin_search(pose.within);
}

void LampEkfEstimator::update(const BearingSet& bearings) {
  measure(bearings);
  if (searching()) return search(bearings);
  const LampMatches& matches = match();
  if (lost_.notices(agreement(matches))) {
    was_tracking_ = true;
    begin_search();
    return search(bearings);
  }
  if (contradicts_the_map(matches)) return doubt();
  agree();
  if (lost_.is_in_doubt()) return;
  if (may_judge_lamps()) map_.weigh_evidence(ekf_, image_, matches);
  apply(matches, bearings);
  if (start_decision_.extends()) extend_map(matches);
}

void LampEkfEstimator::measure(const BearingSet& bearings) {
  recognition_.troubles.add(bearings.trouble, recognition_.path_m);
  map_.begin_image(recognition_.path_m);
  view_.measure(bearings, camera_or_exact(), image_);
  sightings_.clear();
  lamps_of_bearings_.assign(bearings.bearings.size(), kNoLamp);
}

CameraErrors LampEkfEstimator::camera_or_exact() const { return ekf_.camera_errors().value_or(CameraErrors{}); }

const LampMatches& LampEkfEstimator::match() {
  const LampMatches& matches = matcher_.match(image_, lamps(), ekf_);
  counts_.rejected += matches.left_out;
  return matches;
}

bool LampEkfEstimator::is_due(const PredictedDirection& predicted) const {
  return map_[predicted.lamp].confirmed && view_.is_in_view(predicted);
}

/// Counts the expected confirmed lamps and the directions that they explain.
ImageAgreement LampEkfEstimator::agreement(const LampMatches& matches) const {
  if (image_.crowded || map_.confirmed() < kFewestEstablished) return {};
  ImageAgreement agreement{.bearings = static_cast<int>(image_.measured.size())};
  double gates_sr = 0.0;
  for (const PredictedDirection& predicted : matches.predicted) {
    if (!is_due(predicted)) continue;
    // m is the tangent of the zenith angle: towards the rim, a step of m is a smaller angle.
    const double m2 = predicted.offset.m.squaredNorm();
    gates_sr += kPi * settings_.gates.chi2 * std::sqrt(predicted.covariance.determinant()) / std::pow(1.0 + m2, 1.5);
    ++agreement.expected;
  }
  for (std::size_t i = 0; i < matches.of.size(); ++i) {
    const PredictedDirection* const paired = matches.paired(i);
    const bool explained = matches.of[i].fate == DirectionFate::ambiguous || (paired != nullptr && is_due(*paired));
    agreement.explained += explained ? 1 : 0;
  }
  agreement.chance = 1.0 - std::exp(-gates_sr / view_.solid_angle_sr());
  return agreement;
}

/// Whether more than a third of the expected lamps is not recognised although there are enough lights. Then the pose is
/// wrong, not the map. Under a regular grid of lamps some directions match by chance at any pose.
bool LampEkfEstimator::contradicts_the_map(const LampMatches& matches) const {
  std::size_t due = 0, recognised = 0;
  for (const PredictedDirection& predicted : matches.predicted) due += is_due(predicted) ? 1 : 0;
  for (std::size_t i = 0; i < matches.of.size(); ++i)
    if (const auto* paired = matches.paired(i)) recognised += map_[paired->lamp].confirmed ? 1 : 0;
  const std::size_t possible = std::min(due, image_.lights);
  return due >= kFewestExpected && possible >= kFewestExpected - 1 && 3 * recognised < 2 * possible;
}

/// An image that contradicts the map does not update the filter. After some such images the covariance of the pose is
/// doubled.
void LampEkfEstimator::doubt() {
  counts_.rejected += image_.measured.size();
  ++recognition_.contradictions;
  doubts_ = std::min(doubts_ + 1, kMostDoubts);
  if (settings_.recover_after_images <= 0 || recognition_.contradictions < settings_.recover_after_images) return;
  recognition_.contradictions = 0;
  ++recognition_.inflations;
  ++counts_.recovered;
  const Eigen::Matrix3d P = ekf_.state().pose_covariance();
  if (!is_too_uncertain(P, health_)) ekf_.inflate_robot(P);
}

/// Counts an image that agrees with the map. A single image may agree by chance, so it must not start a second map.
void LampEkfEstimator::agree() {
  recognition_.contradictions = std::max(recognition_.contradictions - 1, 0);
  doubts_ = std::max(doubts_ - 1, 0);
}

void LampEkfEstimator::apply(const LampMatches& matches, const BearingSet& bearings) {
  const bool applied = correct(matches);
  for (std::size_t i = 0; i < matches.of.size(); ++i) {
    counts_.ambiguous += matches.of[i].fate == DirectionFate::ambiguous ? 1 : 0;
    counts_.rejected += matches.of[i].fate == DirectionFate::refused ? 1 : 0;
    const PredictedDirection* const paired = matches.paired(i);
    if (paired == nullptr || !applied) continue;
    const Lamp& lamp = map_[paired->lamp];
    const Bearing& bearing = bearings.bearings[image_.bearing_of[i]];
    ++counts_.accepted;
    map_.was_seen(paired->lamp);
    lamps_of_bearings_[image_.bearing_of[i]] = lamp.id;
    if (!lamp.confirmed) continue;  // Lamps on probation are not published, so nobody could interpret this id
    const Eigen::Vector2d variance_rad2 = view_.directions().covariance(bearing).diagonal();
    sightings_.push_back({.landmark_id = lamp.id,
                          .azimuth_rad = bearing.azimuth_rad,
                          .sigma_rad = std::sqrt(variance_rad2.x()),
                          .elevation_rad = bearing.elevation_rad,
                          .sigma_elevation_rad = std::sqrt(variance_rad2.y())});
    recognition_.recognised();
    recognition_.inflations = 0;
  }
  map_.note_apart(matches);
}

/// Only proven lamps update the pose; detections of other lamps update these lamps alone.
bool LampEkfEstimator::correct(const LampMatches& matches) {
  accepted_.clear();
  doubtful_.clear();
  for (std::size_t i = 0; i < matches.of.size(); ++i) {
    const PredictedDirection* const paired = matches.paired(i);
    if (paired == nullptr) continue;
    const Lamp& lamp = map_[paired->lamp];
    (lamp.evidence.proven() ? accepted_ : doubtful_).push_back({lamp.at, image_.seen[i]});
  }
  if (!ekf_.update(accepted_)) return false;
  for (const MappedLampSighting& sighting : doubtful_) ekf_.update_lamp(sighting);
  return true;
}

/// Misses count only if another lamp was recognised in the image: in the dark all lamps are missed, but none is gone.
/// In a crowded image misses do not count either.
void LampEkfEstimator::extend_map(const LampMatches& matches) {
  if (may_judge_lamps() && !sightings_.empty()) map_.count_misses(matches);
  map_.tidy(ekf_);
  if (may_judge_lamps()) map_.add(ekf_, image_, matches);
  if (map_.promote_converged(ekf_)) recognition_.recognised();
}

/// Starts a relocalisation. The map stays unchanged until the robot is found in it.
void LampEkfEstimator::begin_search(const std::optional<PositionPrior>& within) {
  std::vector<KnownLandmark> known;
  for (const Lamp& lamp : lamps()) {
    if (!lamp.confirmed) continue;
    const LampPoint point = ekf_.point(lamp.at);
    known.push_back({.p_map_m = point.p_map_lamp_m, .covariance_m2 = point.covariance_m2, .identity = lamp.identity});
  }
  lost_.begin_search(known, camera_view(), within);
  ekf_.place_robot(ekf_.state().pose(), LostRobot::anywhere());
}

/// The camera's height, field of view and range for a relocalisation.
CameraView LampEkfEstimator::camera_view() const {
  double highest_m = 0.0;
  for (const Lamp& lamp : lamps())
    if (lamp.confirmed) highest_m = std::max(highest_m, ekf_.point(lamp.at).p_map_lamp_m.z());
  CameraView view;
  view.height_m = ekf_.camera_height_m();
  view.min_elevation_rad = kPi / 2.0 - view_.max_zenith_rad();
  view.rim = settings_.view.inner_margin;
  view.max_distance_m = std::max(0.0, highest_m - view.height_m) * std::tan(view_.max_zenith_rad());
  view.detection_probability = 1.0 - std::exp(view_.log_missed());
  return view;
}

void LampEkfEstimator::search(const BearingSet& bearings) {
  directions_seen_.clear();
  for (const MeasuredDirection& measured : image_.measured) directions_seen_.push_back(seen_direction(measured));
  std::optional<PoseHypothesis> found = lost_.look(directions_seen_);
  if (!found && was_tracking_) found = lost_.nearby(ekf_.state().pose());
  if (found) settle_at(*found, bearings);
}

/// Matches the lamps of the last image at the relocalised pose, and lets them determine the pose from a wide prior. The
/// pose thereby gets its correct correlation with the map.
void LampEkfEstimator::settle_at(const PoseHypothesis& found, const BearingSet& bearings) {
  const Eigen::Matrix3d covariance = kDoubtfulFactor * found.covariance;
  ekf_.place_robot(found.T_map_body, covariance);
  const LampMatches& matches = match();
  const auto pairs = std::ranges::count(matches.of, DirectionFate::paired, &DirectionMatch::fate);
  if (static_cast<std::size_t>(pairs) >= kFewestLampsToPlace)
    ekf_.place_robot(found.T_map_body, covariance + independent(kNear_m, kNear_rad));
  lost_.was_found();
  ++counts_.recovered;
  doubts_ = 0;
  recognition_.agreed();
  map_.hold_judgement();
  apply(matches, bearings);
}

std::unique_ptr<Estimator> make_lamp_ekf_estimator(const Rig& rig, const LampEkfSettings& settings,
                                                   const MapStart& start, const HealthSettings& health,
                                                   const RelocalisationSettings& relocalisation) {
  const bool exact = filter_model(rig, settings).sigma_centre_px <= 0.0;
  if (exact || start.map != nullptr || !SecondStart::is_of_use(settings.centre))
    return std::make_unique<LampEkfEstimator>(rig, settings, start, health, relocalisation);
  auto begin = [=](const std::optional<Restart>& again) -> std::unique_ptr<RestartableEstimator> {
    if (!again) return std::make_unique<LampEkfEstimator>(rig, settings, MapStart{}, health, relocalisation);
    return std::make_unique<LampEkfEstimator>(rig, settings, *again, health, relocalisation);
  };
  return std::make_unique<SecondStart>(std::move(begin), settings.centre.second_start_px);
}

}  // namespace azimuth
