#include "slam/estimator/ekf_estimator.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "slam/estimator/bearing_noise.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/make_estimator.hpp"
#include "slam/estimator/odometry_floors.hpp"
#include "slam/estimator/second_start.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewLandmarks = 256;             // storage at the start; it grows with the map
constexpr int kSightings = 3, kSightingsInImages = 8;  // until a landmark is believed to be one
constexpr std::size_t kFewestToTest = 4;               // three bearings fit some pose whatever they are of

/// Features are told apart by their looks.
bool by_looks(const Rig& rig) { return rig.front_end == FrontEnd::sift && !rig.camera.identities; }

/// With what follows from the rig, and what applies to features where there are some.
EkfSettings settings_for(const Rig& rig, EkfSettings settings) {
  if (settings.kl_threshold <= 0.0) settings.kl_threshold = printed_kl_threshold(rig.camera.sigma_bearing_rad);
  if (settings.confirm_after_sightings == 0)
    settings.confirm_after_sightings = rig.front_end == FrontEnd::bearings ? kSightings : kSightingsInImages;
  if (!by_looks(rig)) return settings;
  settings.min_observations = std::max(settings.min_observations, settings.identity.min_observations);
  settings.max_iterations = std::min(settings.max_iterations, settings.identity.max_iterations);
  return settings;
}

Initialisation chosen_initialisation(const Rig& rig, const EkfSettings& settings) {
  const bool named = rig.camera.identities || by_looks(rig);
  if (settings.initialisation == Initialisation::undelayed || !named) return Initialisation::undelayed;
  if (settings.initialisation == Initialisation::delayed) return Initialisation::delayed;
  // The quality test compares parallax with the bearing's noise and is spoilt by the heading's. In a narrow view, or
  // when a metre of odometry turns the heading by more than a bearing's error, it never passes (SPEC part V). Without
  // identities bearings of an unmapped landmark cannot be told apart.
  const bool all_round = rig.camera.field_of_view_rad > kPi;
  const double heading_variance_of_a_metre =
      rig.odometry.lambda_drift_rad2_per_m + rig.odometry.floor_rotation_rad * rig.odometry.floor_rotation_rad;
  const bool steady = heading_variance_of_a_metre < rig.camera.sigma_bearing_rad * rig.camera.sigma_bearing_rad;
  return all_round && steady ? Initialisation::delayed : Initialisation::undelayed;
}

/// A narrow view shows one or two landmarks at a time, which proves little: it takes a prediction within a tenth of a
/// radian to believe that one is seen again. All round, the bearings of an image confirm each other; and in the first
/// metres, when most is decided, an image shows two or three things that no image has shown before.
double chosen_new_density_per_rad(const Rig& rig, const EkfSettings& settings) {
  if (settings.new_density_per_rad > 0.0) return settings.new_density_per_rad;
  if (rig.camera.field_of_view_rad <= kPi) return 4.0;
  return rig.front_end == FrontEnd::bearings ? 0.16 : 0.4;
}

BearingEkfSettings filter_settings(const Rig& rig, const EkfSettings& settings) {
  BearingEkfSettings filter;
  filter.retraction = settings.invariant_update ? JointState::Retraction::invariant : JointState::Retraction::additive;
  filter.max_iterations = settings.max_iterations;
  filter.iterate_below_heading_rad = settings.iterate_below_heading_rad;
  filter.min_distance_m = settings.min_distance_m;
  filter.yaw_offset_rad = rig.camera.yaw_offset_rad;
  filter.estimate_yaw = settings.estimate_camera_yaw;
  filter.sigma_yaw_rad = settings.sigma_camera_yaw_rad;
  if (rig.front_end != FrontEnd::bearings) filter.sigma_centre_px = settings.sigma_camera_centre_px;
  filter.charge_curvature = settings.charge_curvature && rig.front_end != FrontEnd::bearings;
  if (settings.consider_scales) filter.sigma_scales = sigma_scales(rig.odometry);
  return filter;
}

BearingEkfSettings with_centre(BearingEkfSettings filter, const SecondBeginning& again) {
  filter.centre_px = again.centre_px;
  filter.sigma_centre_px = again.sigma_centre_px;
  return filter;
}

}  // namespace

EkfEstimator::EkfEstimator(const Rig& rig, const EkfSettings& settings, const MapStart& start)
    : EkfEstimator(rig, settings, filter_settings(rig, settings_for(rig, settings))) {
  if (start.map != nullptr && is_worth_starting_from(start)) start_from(start);
}

EkfEstimator::EkfEstimator(const Rig& rig, const EkfSettings& settings, const SecondBeginning& again)
    : EkfEstimator(rig, settings, with_centre(filter_settings(rig, settings_for(rig, settings)), again)) {
  next_id_ = again.next_id;  // NOLINT(cppcoreguidelines-prefer-member-initializer): the constructor above has made it
}

EkfEstimator::EkfEstimator(const Rig& rig, const EkfSettings& settings, const BearingEkfSettings& filter)
    : rig_(rig),
      settings_(settings_for(rig, settings)),
      initialisation_(chosen_initialisation(rig, settings)),
      new_density_per_rad_(chosen_new_density_per_rad(rig, settings)),
      ekf_(filter),
      candidates_(settings_, rig.camera),
      duplicates_(settings_),
      watch_(settings_.relocalisation) {
  landmarks_.reserve(kFewLandmarks);
  visible_.reserve(kFewLandmarks);
  visible_azimuths_rad_.reserve(kFewLandmarks);
  visible_kinds_.reserve(kFewLandmarks);
  matches_.reserve(kFewLandmarks);
  points_.reserve(kFewLandmarks);
  sightings_.reserve(kFewLandmarks);
  measured_.reserve(kFewLandmarks);
  gated_.reserve(kFewLandmarks);
  innovations_.reserve(kFewLandmarks);
  unmapped_.reserve(kFewLandmarks);
  accepted_.reserve(kFewLandmarks);
  if (by_looks(rig))
    identities_.emplace(settings.identity, rig.camera.sigma_bearing_rad, settings.max_viewing_distance_m);
}

double EkfEstimator::variance_rad2(const Bearing& bearing) const {
  const double sigma = sigma_rad(bearing, rig_.camera);
  return sigma * sigma;
}

MappedSighting EkfEstimator::sighting_of(const Landmark& landmark, const Bearing& bearing) const {
  return {JointState::kPose,   landmark.block,         landmark.block_kind,
          bearing.azimuth_rad, variance_rad2(bearing), bearing.radius_px};
}

void EkfEstimator::predict(const Motion& motion) {
  ekf_.predict(with_floors(motion, rig_.odometry));
  path_m_ += motion.path_m;
  if (searching_) relocaliser_->predict(with_floors(motion, rig_.odometry));
}

void EkfEstimator::update(const BearingSet& bearings) {
  troubles_.add(bearings.trouble, path_m_);
  matches_.clear();
  unmapped_.clear();
  accepted_.clear();
  sightings_.clear();
  const BearingSet& observations = identities_ ? named(bearings) : bearings;
  if (!searching_) watch_.add(agreement(observations));
  if (watch_.is_lost()) begin_search();
  if (searching_) return search(observations);
  if (has_names())
    match_identities(observations);
  else
    match_by_position(observations);
  gate_individually();
  gate_jointly();
  if (!relocate(observations)) {
    if (watch_.doubts()) return;
    apply_matches(observations.stamp);
    recover();
  }
  if (maps()) extend_map(observations.stamp);
}

void EkfEstimator::extend_map(Stamp stamp) {
  merge_duplicates(stamp);
  drop_on_probation();
  add_unmapped(stamp);
  promote_converged();
  if (identities_) identities_->learn(path_m_);
}

/// Names for features, by their looks and by what the filter believes.
const BearingSet& EkfEstimator::named(const BearingSet& observations) {
  write_sighted(ekf_, candidates_, beliefs_);
  beliefs_.anywhere = searching_;
  beliefs_.mapped.clear();
  for (const Landmark& landmark : landmarks_)
    if (const auto row = ekf_.linearise(sighting_of(landmark, Bearing{})))
      beliefs_.mapped.push_back({landmark.identity, wrap(-row->innovation), ekf_.prediction_covariance(*row, *row)});
  std::ranges::sort(beliefs_.mapped, std::less{}, &IdentityBeliefs::Mapped::identity);
  return identities_->name(observations, beliefs_);
}

/// Names make it possible to find the pose from one image alone (relocation.hpp).
bool EkfEstimator::relocate(const BearingSet& observations) {
  if (!has_names() || settings_.relocation_bearings <= 0) return false;
  const auto rejected = std::count_if(matches_.begin(), matches_.end(), [](const Match& m) { return !m.accepted; });
  if (!is_in_doubt(belief(), static_cast<std::size_t>(rejected), matches_.size(), settings_)) return false;
  named_.clear();
  named_landmarks_.clear();
  for (const Bearing& bearing : observations.bearings)
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const Landmark& landmark = landmarks_[i];
      if (bearing.identity == kUnknownIdentity || landmark.identity != bearing.identity ||
          landmark.block_kind != BlockKind::point || repeats_a_name(bearing, observations))
        continue;
      named_.push_back(sighting_of(landmark, bearing));
      named_landmarks_.push_back(i);
    }
  if (named_.size() < std::max<std::size_t>(kFewestToTest, static_cast<std::size_t>(settings_.relocation_bearings)))
    return false;
  const std::optional<Resection> found = ekf_.resect(named_);
  if (!found || !replaces(*found, named_.size(), belief(), settings_)) return false;
  ekf_.relocate(named_, *found);
  for (std::size_t i = 0; i < named_.size(); ++i) {
    Landmark& landmark = landmarks_[named_landmarks_[i]];
    landmark.was_seen(named_[i].radius_px, path_m_, observations.stamp);
    sightings_.push_back({landmark.id, named_[i].azimuth_rad, std::sqrt(named_[i].variance_rad2)});
  }
  counts_.accepted += named_.size();
  ++counts_.recovered;
  was_found();
  return true;
}

void EkfEstimator::apply_matches(Stamp stamp) {
  for (const Match& match : matches_)
    if (match.accepted) accepted_.push_back(match.sighting);
  const bool applied = ekf_.update(accepted_);
  for (const Match& match : matches_) {
    Landmark& landmark = landmarks_[match.landmark];
    if (match.accepted && applied) {
      landmark.was_seen(match.sighting.radius_px, path_m_, stamp);
      ++counts_.accepted;
      sightings_.push_back({landmark.id, match.sighting.azimuth_rad, std::sqrt(match.sighting.variance_rad2)});
      note_range(landmark);
    } else {
      ++landmark.rejected_in_row;
      ++counts_.rejected;
      ++deaf_sightings_;
      if (identities_) identities_->refuse(landmark.identity);
    }
  }
  if (!accepted_.empty() && applied) {
    deaf_sightings_ = deaf_streaks_ = 0;
    last_accepted_m_ = path_m_;
  }
}

/// How far the camera sees, as experience says.
void EkfEstimator::note_range(const Landmark& landmark) {
  constexpr double kForgetting = 0.9999;
  if (landmark.block_kind != BlockKind::point) return;
  const double distance_m = (ekf_.state().position(landmark.block) - ekf_.state().pose().position()).norm();
  seen_range_m_ = std::max(kForgetting * seen_range_m_, distance_m);
}

void EkfEstimator::estimate(Estimate& out) const {
  write(belief(), path_m_, out);
  out.accepted.assign(sightings_.begin(), sightings_.end());
  for (const Landmark& landmark : landmarks_) {
    LandmarkEstimate& entry = out.landmarks.emplace_back();
    entry.id = landmark.id;
    entry.identity = identities_ ? kUnknownIdentity : landmark.identity;  // ours are no sensor's names
    if (landmark.block_kind == BlockKind::point) {
      entry.p_map_landmark_m = ekf_.state().position(landmark.block);
      entry.covariance_m2 =
          ekf_.state().position_covariance(landmark.block) + by_scales<2>(ekf_.state(), landmark.block);
    } else {
      Eigen::Matrix<double, 2, 4> jacobian;
      entry.p_map_landmark_m = point_of(ekf_.ray(landmark.block), &jacobian);
      Eigen::Matrix4d P;
      for (Index c = 0; c < 4; ++c)
        for (Index r = 0; r < 4; ++r) P(r, c) = ekf_.state().covariance(landmark.block + r, landmark.block + c);
      entry.covariance_m2 = jacobian * P * jacobian.transpose() + by_scales(ekf_.state(), landmark.block, jacobian);
    }
  }
}

void EkfEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  write(moved(belief(), motion), path_m_ + motion.path_m, out);
}

void EkfEstimator::write(const PoseBelief& belief, double path_m, Estimate& out) const {
  write_belief(belief, counts_, judged(belief.covariance, path_m), out);
}

Judgement EkfEstimator::judged(const Eigen::Matrix3d& covariance, double path_m) const {
  if (searching_) return {Health::lost, why_lost()};
  if (watch_.doubts()) return {Health::degraded, "bearings contradict the map"};
  return judge({.pose_covariance = covariance,
                .landmarks = landmarks_.size(),
                .max_landmarks = static_cast<std::size_t>(settings_.max_landmarks),
                .unrecognised_m = path_m - last_accepted_m_,
                .deaf_sightings = deaf_sightings_,
                .deaf_streaks = deaf_streaks_,
                .troubled_images = troubles_.in_row(),
                .trouble = troubles_.last(),
                .centre_offset = ekf_.centre_offset()},
               settings_.health);
}

std::unique_ptr<Estimator> make_ekf_estimator(const Rig& rig, const EkfSettings& settings, const MapStart& start) {
  if (start.map != nullptr || rig.front_end != FrontEnd::colour ||
      !SecondStart::is_of_use(settings.sigma_camera_centre_px, settings.second_start_centre_px))
    return std::make_unique<EkfEstimator>(rig, settings, start);
  auto begin = [=](const std::optional<SecondBeginning>& again) -> std::unique_ptr<BeginsTwice> {
    if (!again) return std::make_unique<EkfEstimator>(rig, settings);
    return std::make_unique<EkfEstimator>(rig, settings, *again);
  };
  return std::make_unique<SecondStart>(std::move(begin), settings.second_start_centre_px);
}

}  // namespace azimuth
