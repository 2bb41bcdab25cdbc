#include "slam/estimator/lamp_ekf_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/estimator/make_estimator.hpp"
#include "slam/estimator/odometry_floors.hpp"
#include "slam/estimator/second_start.hpp"

namespace azimuth {
namespace {

constexpr double kMostDetection = 0.95;
constexpr double kUsualMaxZenith_rad = 1.4;
constexpr std::size_t kFewLamps = 64;  // storage at the start; it grows with the map

double detection_probability(const Rig& rig, const LampEkfSettings& settings) {
  const double by_rig = rig.camera.image.detection_probability.value_or(kUsualDetection);
  return std::min(settings.detection_probability > 0.0 ? settings.detection_probability : by_rig, kMostDetection);
}

double max_zenith_rad(const Rig& rig, const LampEkfSettings& settings) {
  if (settings.max_zenith_rad > 0.0) return settings.max_zenith_rad;
  return std::min(rig.camera.image.theta_max_rad.value_or(kUsualMaxZenith_rad), kUsualMaxZenith_rad);
}

LampEkfModel filter_model(const Rig& rig, const LampEkfSettings& settings) {
  LampEkfModel model;
  model.retraction = settings.invariant_update ? JointState::Retraction::invariant : JointState::Retraction::additive;
  model.camera_height_m = rig.camera.image.viewpoint_height_m.value_or(kUnknownHeight_m);
  model.min_height_m = settings.min_height_m;
  if (rig.front_end != FrontEnd::bearings && LampDirections(rig).has_camera())
    model.sigma_centre_px = settings.sigma_camera_centre_px;
  model.sigma_scales = sigma_scales(rig.odometry);
  return model;
}

LampEkfModel with_centre(LampEkfModel model, const SecondBeginning& again) {
  model.centre_px = again.centre_px;
  model.sigma_centre_px = again.sigma_centre_px;
  return model;
}

}  // namespace

LampEkfEstimator::LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const MapStart& start,
                                   const RelocalisationSettings& relocalisation)
    : LampEkfEstimator(rig, settings, filter_model(rig, settings), relocalisation) {
  if (start.map != nullptr) start_from(start);
}

LampEkfEstimator::LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const SecondBeginning& again,
                                   const RelocalisationSettings& relocalisation)
    : LampEkfEstimator(rig, settings, with_centre(filter_model(rig, settings), again), relocalisation) {
  next_id_ = again.next_id;
}

/// Heights from h - s to h + s are inverse heights of the mean h / (h^2 - s^2), give or take s / (h^2 - s^2).
LampEkfEstimator::LampEkfEstimator(const Rig& rig, const LampEkfSettings& settings, const LampEkfModel& model,
                                   const RelocalisationSettings& relocalisation)
    : rig_(rig),
      settings_(settings),
      directions_(rig),
      max_zenith_rad_(max_zenith_rad(rig, settings)),
      log_seen_(std::log(detection_probability(rig, settings) / settings.new_density_per_sr)),
      log_missed_(std::log(1.0 - detection_probability(rig, settings))),
      ekf_(model),
      relocalisation_(relocalisation),
      watch_(relocalisation),
      relocaliser_(relocalisation) {
  const double h = settings.height_m, s = std::min(settings.height_sigma_m, 0.95 * h);
  inverse_height_per_m_ = h / (h * h - s * s);
  sigma_inverse_height_per_m_ = s / (h * h - s * s);
  lamps_.reserve(kFewLamps);
  apart_.reserve(kFewLamps);
  predicted_.reserve(kFewLamps);
  for (auto* list : {&bearing_of_, &near_}) list->reserve(kFewLamps);
  seen_.reserve(kFewLamps);
  measured_.reserve(kFewLamps);
  near_offsets_.reserve(kFewLamps);
  near_identities_.reserve(kFewLamps);
  matches_.reserve(kFewLamps);
  for (auto* list : {&accepted_, &doubtful_}) list->reserve(kFewLamps);
  lamps_of_bearings_.reserve(kFewLamps);
  sightings_.reserve(kFewLamps);
  directions_seen_.reserve(kFewLamps);
}

void LampEkfEstimator::predict(const Motion& motion) {
  ekf_.predict(with_floors(motion, rig_.odometry));
  path_m_ += motion.path_m;
  if (searching_) relocaliser_.predict(with_floors(motion, rig_.odometry));
}

void LampEkfEstimator::update(const BearingSet& bearings) {
  ++image_;
  troubles_.add(bearings.trouble, path_m_);
  measure(bearings);
  if (searching_) return search(bearings);
  recognise();
  watch_.add(agreement());
  if (watch_.is_lost()) {
    was_tracking_ = true;
    begin_search();
    return search(bearings);
  }
  if (contradicts_the_map()) return recover();
  agree();
  if (watch_.doubts()) return;
  weigh_evidence();
  apply_matches(bearings);
  if (mode_ == MapMode::extend) extend_map();
}

void LampEkfEstimator::recognise() {
  predict_lamps();
  thin_crowded();
  find_near();
  match();
}

void LampEkfEstimator::extend_map() {
  count_misses();
  merge_twins();
  forget_doubtful();
  add_new();
  promote_converged();
}

/// The directions of use: above the horizon, as far down as the camera is to be trusted.
void LampEkfEstimator::measure(const BearingSet& bearings) {
  const CentreOffset centre = centre_or_exact();
  seen_.clear();
  measured_.clear();
  bearing_of_.clear();
  sightings_.clear();
  lamps_of_bearings_.assign(bearings.bearings.size(), kNoLamp);
  bool any_elevation = false;
  for (std::size_t i = 0; i < bearings.bearings.size(); ++i) {
    const Bearing& bearing = bearings.bearings[i];
    if (!std::isfinite(bearing.elevation_rad)) continue;
    any_elevation = true;
    if (!(kPi / 2.0 - bearing.elevation_rad <= max_zenith_rad_)) continue;
    const LampSeen seen = directions_.seen(bearing, centre.mean_px);
    const Eigen::Vector2d by_centre = (seen.by_centre * centre.covariance_px2 * seen.by_centre.transpose()).diagonal();
    seen_.push_back(seen);
    measured_.push_back({seen.direction, bearing.identity});
    measured_.back().seen.add_variance(by_centre);
    bearing_of_.push_back(i);
  }
  without_elevation_ = !any_elevation && !bearings.bearings.empty();
}

CentreOffset LampEkfEstimator::centre_or_exact() const {
  return ekf_.centre_offset().value_or(CentreOffset{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()});
}

void LampEkfEstimator::predict_lamps() {
  predicted_.clear();
  for (std::size_t i = 0; i < lamps_.size(); ++i)
    if (const auto offset = ekf_.predict(lamps_[i].at))
      predicted_.push_back({i, *offset, ekf_.covariance(*offset, *offset)});
}

/// Among so many directions a lamp on probation would find one that suits it wherever it is.
void LampEkfEstimator::find_near() {
  near_.clear();
  near_offsets_.clear();
  near_identities_.clear();
  for (std::size_t k = 0; k < predicted_.size(); ++k) {
    const Lamp& lamp = lamps_[predicted_[k].lamp];
    if ((crowded_ && !lamp.confirmed) || !is_near_a_direction(predicted_[k])) continue;
    near_.push_back(k);
    near_offsets_.push_back(predicted_[k].offset.m);
    near_identities_.push_back(lamp.identity);
  }
}

bool LampEkfEstimator::is_near_a_direction(const Predicted& predicted) const {
  return std::ranges::any_of(measured_, [&](const MeasuredDirection& measured) {
    return squared_distance(measured, predicted) < settings_.gate_chi2;
  });
}

/// nu^T S^-1 nu; without end where there is no comparing.
double LampEkfEstimator::squared_distance(const MeasuredDirection& measured, const Predicted& predicted) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto residual = measured.seen.against(predicted.offset.m);
  if (!residual) return kNever;
  const Eigen::Matrix2d& D = residual->by_offset;
  Eigen::Matrix2d S = D * predicted.covariance * D.transpose();
  S.diagonal() += measured.seen.variance();
  const Eigen::Vector2d& nu = residual->innovation;
  const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
  const double scaled = S(1, 1) * nu.x() * nu.x() - 2.0 * S(0, 1) * nu.x() * nu.y() + S(0, 0) * nu.y() * nu.y();
  return determinant > 0.0 ? scaled / determinant : kNever;
}

void LampEkfEstimator::match() {
  const auto size = 2 * static_cast<Index>(near_.size());
  auto covariance = near_covariance_.matrix(size, size);
  for (std::size_t r = 0; r < near_.size(); ++r)
    for (std::size_t c = 0; c <= r; ++c) {
      const Eigen::Matrix2d block = r == c ? predicted_[near_[r]].covariance
                                           : ekf_.covariance(predicted_[near_[r]].offset, predicted_[near_[c]].offset);
      const Index row = 2 * static_cast<Index>(r), column = 2 * static_cast<Index>(c);
      covariance.block<2, 2>(row, column) = block;
      covariance.block<2, 2>(column, row) = block.transpose();
    }
  const DirectionGates gates{settings_.gate_chi2, settings_.joint_gate_probability, new_density_per_sr_,
                             settings_.rival_log_ratio};
  matching_.match(measured_, {near_offsets_, covariance, near_identities_}, gates, matches_);
}

const LampEkfEstimator::Predicted& LampEkfEstimator::paired(const DirectionMatch& match) const {
  return predicted_[near_[static_cast<std::size_t>(match.landmark)]];
}

void LampEkfEstimator::apply_matches(const BearingSet& bearings) {
  const bool applied = correct();
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    counts_.ambiguous += matches_[i].fate == DirectionFate::ambiguous ? 1 : 0;
    counts_.rejected += matches_[i].fate == DirectionFate::refused ? 1 : 0;
    if (matches_[i].fate != DirectionFate::paired || !applied) continue;
    Lamp& lamp = lamps_[paired(matches_[i]).lamp];
    lamps_of_bearings_[bearing_of_[i]] = lamp.id;
    count_sighting(lamp, bearings.bearings[bearing_of_[i]]);
  }
  note_apart();
}

void LampEkfEstimator::count_sighting(Lamp& lamp, const Bearing& bearing) {
  ++counts_.accepted;
  ++lamp.sightings;
  lamp.missed_in_row = 0;
  lamp.last_image = image_;
  lamp.last_seen_m = path_m_;
  lamp.log_odds = std::min(lamp.log_odds + log_seen_, settings_.most_log_odds);
  if (!lamp.confirmed) return;  // not published: nobody would know what it refers to
  sightings_.push_back({lamp.id, bearing.azimuth_rad, std::sqrt(directions_.covariance(bearing)(0, 0))});
  last_accepted_m_ = path_m_;
  deaf_streaks_ = 0;
}

void LampEkfEstimator::estimate(Estimate& out) const {
  write(belief(), path_m_, out);
  out.accepted.assign(sightings_.begin(), sightings_.end());
  for (const Lamp& lamp : lamps_) {
    if (!lamp.confirmed) continue;
    LampPoint point = ekf_.point(lamp.at);
    point.covariance_m2 += ekf_.covariance_by_scales(lamp.at);
    LandmarkEstimate& entry = out.landmarks.emplace_back();
    entry.id = lamp.id;
    entry.identity = lamp.identity;
    entry.p_map_landmark_m = point.p_map_lamp_m.head<2>();
    entry.covariance_m2 = point.covariance_m2.topLeftCorner<2, 2>();
    entry.z_map_landmark_m = point.p_map_lamp_m.z();
    entry.sigma_z_m = std::sqrt(point.covariance_m2(2, 2));
  }
}

void LampEkfEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  write(moved(belief(), motion), path_m_ + motion.path_m, out);
}

void LampEkfEstimator::write(const PoseBelief& belief, double path_m, Estimate& out) const {
  write_belief(belief, counts_, judged(belief.covariance, path_m), out);
}

Judgement LampEkfEstimator::judged(const Eigen::Matrix3d& covariance, double path_m) const {
  if (searching_) return {Health::lost, why_lost()};
  if (watch_.doubts()) return {Health::degraded, "bearings contradict the map"};
  Judgement judgement = judge({.pose_covariance = covariance,
                               .landmarks = confirmed(),
                               .max_landmarks = static_cast<std::size_t>(settings_.max_landmarks),
                               .unrecognised_m = path_m - last_accepted_m_,
                               .deaf_sightings = contradictions_,
                               .deaf_streaks = deaf_streaks_,
                               .troubled_images = troubles_.in_row(),
                               .trouble = troubles_.last(),
                               .centre_offset = ekf_.centre_offset()},
                              settings_.health);
  if (without_elevation_ && judgement.health == Health::starting) judgement.reason = "bearings bring no elevation";
  if (judgement.health == Health::starting && !lamps_.empty() && !any_proven())
    judgement.reason = "no landmark is known to be a lamp and not a reflection";
  if (crowded_ && judgement.health == Health::starting) judgement.reason = "too many lights to begin a map with";
  return judgement;
}

std::unique_ptr<Estimator> make_lamp_ekf_estimator(const Rig& rig, const LampEkfSettings& settings,
                                                   const MapStart& start,
                                                   const RelocalisationSettings& relocalisation) {
  const bool exact = filter_model(rig, settings).sigma_centre_px <= 0.0;
  if (exact || start.map != nullptr ||
      !SecondStart::is_of_use(settings.sigma_camera_centre_px, settings.second_start_centre_px))
    return std::make_unique<LampEkfEstimator>(rig, settings, start, relocalisation);
  auto begin = [=](const std::optional<SecondBeginning>& again) -> std::unique_ptr<BeginsTwice> {
    if (!again) return std::make_unique<LampEkfEstimator>(rig, settings, MapStart{}, relocalisation);
    return std::make_unique<LampEkfEstimator>(rig, settings, *again, relocalisation);
  };
  return std::make_unique<SecondStart>(std::move(begin), settings.second_start_centre_px);
}

}  // namespace azimuth
