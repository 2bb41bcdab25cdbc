#include "slam/estimator/ekf_estimator.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "slam/estimator/bearing_noise.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/make_estimator.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewLandmarks = 256;  // storage at the start; it grows with the map
constexpr std::size_t kFewestToTest = 4;    // three bearings fit some pose whatever they are of

/// Features are told apart by their looks.
bool by_looks(const Rig& rig) { return rig.front_end == FrontEnd::sift && !rig.camera.identities; }

/// What applies to features, where there are some.
EkfSettings settings_for(const Rig& rig, EkfSettings settings) {
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
/// radian to believe that one is seen again. All round, the bearings of an image confirm each other.
double chosen_new_density_per_rad(const Rig& rig, const EkfSettings& settings) {
  if (settings.new_density_per_rad > 0.0) return settings.new_density_per_rad;
  return rig.camera.field_of_view_rad > kPi ? 0.16 : 4.0;
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
  return filter;
}

/// Whether an earlier bearing of the same image has the same name: a name stands for one landmark.
bool repeats_a_name(const Bearing& bearing, const BearingSet& image) {
  const auto named_alike = [&](const Bearing& other) { return other.identity == bearing.identity; };
  return &*std::find_if(image.bearings.begin(), image.bearings.end(), named_alike) != &bearing;
}

}  // namespace

EkfEstimator::EkfEstimator(const Rig& rig, const EkfSettings& settings)
    : rig_(rig),
      settings_(settings_for(rig, settings)),
      initialisation_(chosen_initialisation(rig, settings)),
      new_density_per_rad_(chosen_new_density_per_rad(rig, settings)),
      ekf_(filter_settings(rig, settings_)),
      candidates_(settings_, rig.camera),
      duplicates_(settings_) {
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
  sightings_.reserve(kFewLandmarks);
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
  Motion charged = motion;
  if (motion.moved()) {  // floors against overconfidence on straight drives (SPEC I.3)
    const double distance_m2 = rig_.odometry.floor_distance_m * rig_.odometry.floor_distance_m;
    const double rotation_rad2 = rig_.odometry.floor_rotation_rad * rig_.odometry.floor_rotation_rad;
    charged.covariance.diagonal() += Eigen::Vector3d(distance_m2, distance_m2, rotation_rad2);
  }
  ekf_.predict(charged);
  path_m_ += motion.path_m;
}

void EkfEstimator::update(const BearingSet& bearings) {
  count_trouble(bearings.trouble);
  matches_.clear();
  unmapped_.clear();
  accepted_.clear();
  sightings_.clear();
  const BearingSet& observations = identities_ ? named(bearings) : bearings;
  if (has_names())
    match_identities(observations);
  else
    match_by_position(observations);
  gate_individually();
  gate_jointly();
  if (!relocate(observations)) {
    apply_matches(observations.stamp);
    recover();
  }
  merge_duplicates(observations.stamp);
  drop_on_probation();
  add_unmapped(observations.stamp);
  promote_converged();
  if (identities_) identities_->learn(path_m_);
}

/// Names for features, by their looks and by what the filter believes.
const BearingSet& EkfEstimator::named(const BearingSet& observations) {
  write_sighted(ekf_, candidates_, beliefs_);
  beliefs_.mapped.clear();
  for (const Landmark& landmark : landmarks_)
    if (const auto row = ekf_.linearise(sighting_of(landmark, Bearing{})))
      beliefs_.mapped.push_back({landmark.identity, wrap(-row->innovation), ekf_.prediction_covariance(*row, *row)});
  std::ranges::sort(beliefs_.mapped, std::less{}, &IdentityBeliefs::Mapped::identity);
  return identities_->name(observations, beliefs_);
}

/// Images that stand still while the robot does are as they should be.
void EkfEstimator::count_trouble(ImageTrouble trouble) {
  const bool moved = path_m_ > last_image_m_;
  last_image_m_ = path_m_;
  if (trouble == ImageTrouble::none)
    troubled_images_ = 0;
  else if (trouble != ImageTrouble::frozen || moved)
    ++troubled_images_;
  trouble_ = trouble;
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
  if (row) matches_.push_back({at, sighting, *row, ekf_.prediction_covariance(*row, *row) + sighting.variance_rad2});
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
  return Visible{at, *centred, wrap(seen.azimuth_rad - centred->innovation)};
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
    const double predicted_variance = ekf_.prediction_covariance(visible->row, visible->row);
    const bool expected = std::any_of(measured_.begin(), measured_.end(), [&](const MeasuredAzimuth& measured) {
      const double innovation = wrap(measured.azimuth_rad - visible->azimuth_rad);
      return same_kind(measured.kind, landmarks_[i].kind) &&
             innovation * innovation < gate * (predicted_variance + measured.variance_rad2);
    });
    if (!expected) continue;
    visible_.push_back(*visible);
    visible_azimuths_rad_.push_back(visible->azimuth_rad);
    visible_kinds_.push_back(landmarks_[i].kind);
  }
  const auto size = static_cast<Index>(visible_.size());
  auto covariance = innovation_covariance_.matrix(size, size);
  for (Index r = 0; r < size; ++r)
    for (Index c = 0; c <= r; ++c)
      covariance(r, c) = covariance(c, r) = ekf_.prediction_covariance(visible_[static_cast<std::size_t>(r)].row,
                                                                       visible_[static_cast<std::size_t>(c)].row);
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
  deaf_sightings_ = deaf_streaks_ = 0;
  last_accepted_m_ = path_m_;
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

/// A streak of rejections must not leave the filter deaf. When nothing at all is accepted the pose is wrong, and its
/// covariance doubles until the map is heard again. When others are accepted the landmark is wrong, and starts anew.
void EkfEstimator::recover() {
  const int streak = settings_.recover_after_rejections;
  if (streak <= 0) return;
  if (deaf_sightings_ >= streak) {
    ekf_.inflate_robot(ekf_.state().pose_covariance());
    deaf_sightings_ = 0;
    ++deaf_streaks_;
    ++counts_.recovered;
  }
  for (std::size_t i = landmarks_.size(); i-- > 0;) {
    const bool others_accepted = deaf_sightings_ == 0 && deaf_streaks_ == 0;
    if (landmarks_[i].rejected_in_row < streak || !others_accepted) continue;
    remove_landmark(i);
    ++counts_.recovered;
  }
}

/// In a narrow view one of two that stand close together is often seen alone, which says nothing.
void EkfEstimator::merge_duplicates(Stamp stamp) {
  if (has_names() || rig_.camera.field_of_view_rad <= kPi) return;
  list_points(stamp);
  duplicates_.observe(ekf_, points_);
  while (const auto pair = duplicates_.find(ekf_, points_)) {
    merge(*pair);
    list_points(stamp);
  }
}

void EkfEstimator::list_points(Stamp stamp) {
  points_.clear();
  for (const Landmark& landmark : landmarks_)
    if (landmark.block_kind == BlockKind::point)
      points_.push_back({landmark.id, landmark.kind, landmark.block, landmark.sightings, landmark.last_used == stamp});
}

void EkfEstimator::merge(const Duplicates::Pair& pair) {
  const auto index_of = [&](std::int64_t id) {
    return static_cast<std::size_t>(std::ranges::find_if(landmarks_, [id](const Landmark& l) { return l.id == id; }) -
                                    landmarks_.begin());
  };
  Landmark& kept = landmarks_[index_of(pair.keep)];
  const std::size_t dropped = index_of(pair.drop);
  if (!pair.agree) return remove_landmark(dropped);
  ekf_.merge(kept.block, landmarks_[dropped].block);
  forget_landmark(dropped);
}

/// Clutter: what was seen once or twice and never again.
void EkfEstimator::drop_on_probation() {
  if (has_names()) return;
  for (std::size_t i = landmarks_.size(); i-- > 0;) {
    const auto confirmed = static_cast<std::uint64_t>(settings_.confirm_after_sightings);
    if (landmarks_[i].sightings < confirmed && path_m_ - landmarks_[i].last_used_m > settings_.probation_m)
      remove_landmark(i);
  }
}

void EkfEstimator::remove_landmark(std::size_t at) {
  ekf_.remove(landmarks_[at].block, landmarks_[at].block_kind);
  forget_landmark(at);
}

void EkfEstimator::forget_landmark(std::size_t at) {
  duplicates_.forget(landmarks_[at].id);
  landmarks_[at] = landmarks_.back();
  landmarks_.pop_back();
  ++counts_.deleted;
}

/// Of features there are always more: a map needs not all of them, and each costs time in every later step.
bool EkfEstimator::sees_enough() const {
  const int enough = settings_.identity.enough_in_sight;
  return identities_ && enough > 0 && static_cast<int>(sightings_.size()) >= enough;
}

void EkfEstimator::add_unmapped(Stamp stamp) {
  if (sees_enough()) {
    for (const Bearing& bearing : unmapped_) identities_->refuse(bearing.identity);
    return;
  }
  const auto room = static_cast<std::size_t>(settings_.max_landmarks) - landmarks_.size();
  if (unmapped_.size() > room) unmapped_.resize(room);
  if (initialisation_ == Initialisation::undelayed) {
    for (const Bearing& bearing : unmapped_) {
      const Index block =
          ekf_.add_ray(bearing.azimuth_rad, sigma_rad(bearing, rig_.camera), settings_.inverse_depth_mean_per_m,
                       settings_.inverse_depth_sigma_per_m, bearing.radius_px);
      add_landmark(
          {.identity = bearing.identity, .kind = bearing.kind, .block_kind = BlockKind::inverse_depth, .block = block},
          1, bearing.radius_px, stamp);
    }
    return;
  }
  candidates_.observe(ekf_, unmapped_);
  for (const Candidates::Created& created : candidates_.created())
    add_landmark({.identity = created.identity, .kind = created.kind, .block = created.block}, created.sightings,
                 created.radius_px, stamp);
}

void EkfEstimator::add_landmark(Landmark landmark, std::uint64_t sightings, double radius_px, Stamp stamp) {
  landmark.id = next_id_++;
  landmark.was_seen(radius_px, path_m_, stamp);
  landmark.sightings = sightings;
  landmarks_.push_back(landmark);
  last_accepted_m_ = path_m_;
  ++counts_.created;
}

void EkfEstimator::promote_converged() {
  if (initialisation_ != Initialisation::undelayed) return;
  for (Landmark& landmark : landmarks_) {
    if (landmark.block_kind != BlockKind::inverse_depth ||
        !(ekf_.linearity_index(landmark.block) < settings_.promote_linearity))
      continue;
    ekf_.promote(landmark.block);
    landmark.block_kind = BlockKind::point;
  }
}

void EkfEstimator::estimate(Estimate& out) const {
  write_pose(ekf_.state().pose(), ekf_.state().pose_covariance(), path_m_, out);
  out.accepted.assign(sightings_.begin(), sightings_.end());
  for (const Landmark& landmark : landmarks_) {
    LandmarkEstimate& entry = out.landmarks.emplace_back();
    entry.id = landmark.id;
    entry.identity = identities_ ? kUnknownIdentity : landmark.identity;  // ours are no sensor's names
    if (landmark.block_kind == BlockKind::point) {
      entry.p_map_landmark_m = ekf_.state().position(landmark.block);
      entry.covariance_m2 = ekf_.state().position_covariance(landmark.block);
    } else {
      Eigen::Matrix<double, 2, 4> jacobian;
      entry.p_map_landmark_m = point_of(ekf_.ray(landmark.block), &jacobian);
      Eigen::Matrix4d P;
      for (Index c = 0; c < 4; ++c)
        for (Index r = 0; r < 4; ++r) P(r, c) = ekf_.state().covariance(landmark.block + r, landmark.block + c);
      entry.covariance_m2 = jacobian * P * jacobian.transpose();
    }
  }
}

void EkfEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  const MovedPose moved = apply(ekf_.state().pose(), motion);
  const Eigen::Matrix3d P = moved.G * ekf_.state().pose_covariance() * moved.G.transpose() + moved.noise;
  write_pose(moved.T_map_body, P, path_m_ + motion.path_m, out);
}

void EkfEstimator::write_pose(const Pose2& T_map_body, const Eigen::Matrix3d& covariance, double path_m,
                              Estimate& out) const {
  out.T_map_body = T_map_body;
  out.pose_covariance = covariance;
  out.association = counts_;
  const Judgement judgement = judge({.pose_covariance = covariance,
                                     .landmarks = landmarks_.size(),
                                     .unrecognised_m = path_m - last_accepted_m_,
                                     .deaf_sightings = deaf_sightings_,
                                     .deaf_streaks = deaf_streaks_,
                                     .troubled_images = troubled_images_,
                                     .trouble = trouble_,
                                     .centre_offset = ekf_.centre_offset()},
                                    settings_);
  out.health = judgement.health;
  out.reason = judgement.reason;
}

std::unique_ptr<Estimator> make_ekf_estimator(const Rig& rig, const EkfSettings& settings) {
  return std::make_unique<EkfEstimator>(rig, settings);
}

}  // namespace azimuth
