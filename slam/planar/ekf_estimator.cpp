#include "slam/planar/ekf_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "slam/estimator/second_start.hpp"
#include "slam/geometry/index.hpp"
#include "slam/planar/ekf_hypotheses.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "slam/planar/relocation.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewestToTest = 4;  // three bearings fit some pose whatever their landmarks
constexpr std::size_t kFewestToPlace = 4;

/// Variance of the difference between the robot's heading and a clone's.
double turn_variance_rad2(const JointState& state, Index clone) {
  const Index then = clone + 2, now = JointState::kPose + 2;
  return state.covariance(then, then) + state.covariance(now, now) - 2.0 * state.covariance(then, now);
}

/// Replaces `out.sighted` and the pose.
void write_sighted(const BearingEkf& ekf, const Candidates& candidates, IdentityBeliefs& out) {
  out.T_map_camera = ekf.state().pose();
  out.T_map_camera.heading_rad = wrap(out.T_map_camera.heading_rad + ekf.yaw_offset_rad());
  out.sighted.clear();
  for (const Candidate& candidate : candidates.candidates())
    for (const Candidate::Bearing& bearing : candidate.seen()) {
      const Index clone = candidates.clones()[as_size(bearing.clone)].block;
      const Sighting then = ekf.sighting_from(clone, bearing.azimuth_rad, bearing.radius_px);
      out.sighted.push_back({candidate.identity, then.T_map_body.position(),
                             wrap(then.T_map_body.heading_rad + then.azimuth_rad),
                             bearing.sigma_rad * bearing.sigma_rad, turn_variance_rad2(ekf.state(), clone)});
    }
  std::ranges::sort(out.sighted, std::less{}, &IdentityBeliefs::Sighted::identity);
}

}  // namespace

EkfEstimator::EkfEstimator(const Rig& rig, const EkfSettings& settings, const std::optional<Restart>& again,
                           const HealthSettings& health, const RelocalisationSettings& relocalisation)
    : EkfOnMap(rig, BearingEkf(filter_settings(rig, settings, again)),
               PlanarMap(rig, settings, chosen_initialisation(rig, settings)), health, relocalisation),
      settings_(settings),
      initialisation_(chosen_initialisation(rig, settings)),
      matcher_(settings, chosen_new_density_per_rad(rig, settings)),
      search_(rig, settings, relocalisation) {
  if (names_by_looks(rig)) names_.emplace(rig, settings);
  accepted_.reserve(kTypicalLandmarks);
}

EkfEstimator::EkfEstimator(const Rig& rig, const EkfSettings& settings, const MapStart& start,
                           const HealthSettings& health, const RelocalisationSettings& relocalisation)
    : EkfEstimator(rig, settings_for(rig, settings), std::optional<Restart>(), health, relocalisation) {
  if (start.map != nullptr && is_worth_starting_from(start)) start_from(start);
}

EkfEstimator::EkfEstimator(const Rig& rig, const EkfSettings& settings, const Restart& again,
                           const HealthSettings& health, const RelocalisationSettings& relocalisation)
    : EkfEstimator(rig, settings_for(rig, settings), std::optional(again), health, relocalisation) {
  map_.continue_from(again.next_id);
}

void EkfEstimator::update(const BearingSet& bearings) {
  recognition_.troubles.add(bearings.trouble, recognition_.path_m);
  sightings_.clear();
  const BearingSet& image = names_ ? names_->name(bearings, landmarks(), candidates(), view(), searching()) : bearings;
  if (!searching() && lost_.notices(agreement(image))) begin_search();
  if (searching()) return search(image);
  const PlanarMatches& matches = match(image);
  if (!relocate(image, matches.rejected(), matches.pairs.size())) {
    if (lost_.is_in_doubt()) return;
    correct(matches.pairs, image.stamp);
    recover();
  }
  if (maps()) extend_map(matches.unmapped, image.stamp);
}

ImageAgreement EkfEstimator::agreement(const BearingSet& image) {
  const bool in_doubt = lost_.is_in_doubt();
  return names_ ? search_.agreement_of_features(image, landmarks(), view(), recognition_.path_m, in_doubt)
                : search_.agreement(image, landmarks(), view(), recognition_.path_m, in_doubt);
}

const JointCompatibility& EkfEstimator::weigh(const BearingSet& bearings, double keep_log_ratio) {
  return matcher_.weigh(bearings, landmarks(), view(), keep_log_ratio);
}

void EkfEstimator::update_as(const BearingSet& bearings, std::size_t hypothesis) {
  hypothesis_ = hypothesis;
  update(bearings);
  hypothesis_.reset();
}

const PlanarMatches& EkfEstimator::match(const BearingSet& image) {
  const PlanarMatches& matches = has_names()   ? matcher_.match_names(image, landmarks(), view())
                                 : hypothesis_ ? matcher_.match_weighed(image, landmarks(), view(), *hypothesis_)
                                               : matcher_.match_places(image, landmarks(), view());
  counts_.rejected += matches.repeated;
  counts_.ambiguous += matches.ambiguous;
  counts_.thinned += matches.thinned;
  return matches;
}

/// Named landmarks allow the pose to be found from a single image (relocation.hpp).
bool EkfEstimator::relocate(const BearingSet& image, std::size_t rejected, std::size_t matched) {
  if (!has_names() || settings_.relocation.bearings <= 0) return false;
  if (!is_in_doubt(belief(), rejected, matched, settings_.relocation)) return false;
  const PlacedSightings& seen = matcher_.named_points(image, landmarks(), view());
  const std::size_t size = seen.sightings.size();
  if (size < std::max(kFewestToTest, as_size(settings_.relocation.bearings))) return false;
  const std::optional<Resection> found = ekf_.resect(seen.sightings);
  if (!found || !replaces(*found, size, belief(), settings_.relocation)) return false;
  ekf_.relocate(seen.sightings, *found);
  for (std::size_t i = 0; i < size; ++i) {
    Landmark& landmark = map_[seen.landmarks[i]];
    const MappedSighting& sighting = seen.sightings[i];
    landmark.was_seen(sighting.radius_px, recognition_.path_m, image.stamp);
    sightings_.push_back({landmark.id, sighting.azimuth_rad, std::sqrt(sighting.variance_rad2), sighting.radius_px});
  }
  counts_.accepted += size;
  ++counts_.recovered;
  was_found();
  return true;
}

void EkfEstimator::correct(std::span<const PlanarMatches::Pair> pairs, Stamp stamp) {
  accepted_.clear();
  for (const PlanarMatches::Pair& pair : pairs)
    if (pair.accepted) accepted_.push_back(pair.sighting);
  const bool applied = ekf_.update(accepted_);
  for (const PlanarMatches::Pair& pair : pairs) {
    Landmark& landmark = map_[pair.landmark];
    const MappedSighting& sighting = pair.sighting;
    if (pair.accepted && applied) {
      landmark.was_seen(sighting.radius_px, recognition_.path_m, stamp);
      ++counts_.accepted;
      sightings_.push_back({landmark.id, sighting.azimuth_rad, std::sqrt(sighting.variance_rad2), sighting.radius_px});
      if (landmark.is_point())
        search_.note_range((ekf_.state().position(landmark.block) - ekf_.state().pose().position()).norm());
    } else {
      ++landmark.rejected_in_row;
      ++counts_.rejected;
      ++recognition_.contradictions;
      if (names_) names_->identities().refuse(landmark.identity);
    }
  }
  if (!accepted_.empty() && applied) recognition_.agreed();
}

/// Ends a streak of rejections. If no bearing at all is accepted, the pose is wrong: its covariance is doubled until
/// bearings agree with the map again. If other bearings are accepted, the landmark is wrong: it is removed, to be
/// initialised again.
void EkfEstimator::recover() {
  const int streak = settings_.recover_after_rejections;
  if (streak <= 0) return;
  if (recognition_.contradictions >= streak) {
    ekf_.inflate_robot(ekf_.state().pose_covariance());
    recognition_.contradictions = 0;
    ++recognition_.inflations;
    ++counts_.recovered;
  }
  if (maps() && recognition_.contradictions == 0 && recognition_.inflations == 0)
    counts_.recovered += map_.remove_contradicted(ekf_, streak);
}

void EkfEstimator::extend_map(std::span<const Bearing> unmapped, Stamp stamp) {
  const PlanarMap::Instant now{stamp, recognition_.path_m};
  map_.tidy(ekf_, now);
  if (sees_enough()) {
    for (const Bearing& bearing : unmapped) names_->identities().refuse(bearing.identity);
  } else if (map_.add(ekf_, unmapped, now)) {
    recognition_.recognised();
  }
  map_.promote_converged(ekf_);
  if (names_) names_->identities().learn(recognition_.path_m);
}

/// An image always shows more features than the map needs, and each one in the map costs time in every later step.
bool EkfEstimator::sees_enough() const {
  const int enough = settings_.identity.enough_in_sight;
  return names_ && enough > 0 && static_cast<int>(sightings_.size()) >= enough;
}

/// The map does not change until the robot is found.
void EkfEstimator::begin_search(const std::optional<PositionPrior>& within) {
  lost_.begin_search(PlanarSearch::known(landmarks(), ekf_.state()), search_.camera_view(ekf_), within);
  ekf_.place_robot(ekf_.state().pose(), LostRobot::anywhere());
}

void EkfEstimator::search(const BearingSet& image) {
  if (relocate(image, 0, 0)) return;
  if (const auto found = lost_.look(search_.directions(image, landmarks(), ekf_))) settle_at(*found, image);
}

/// Sets the pose to the one found. If the last image suffices to compute a pose near the one found, the computed pose
/// replaces it, with its correlation with the map.
void EkfEstimator::settle_at(const PoseHypothesis& found, const BearingSet& image) {
  ekf_.place_robot(found.T_map_body, kDoubtfulFactor * found.covariance);
  const PlacedSightings& seen = matcher_.undisputed_points(image, landmarks(), view(), has_names());
  std::optional<Resection> placed;
  if (seen.sightings.size() >= kFewestToPlace) placed = ekf_.resect(seen.sightings);
  if (placed) {
    const Pose2 off = inverse(found.T_map_body) * placed->T_map_body;
    if (off.position().norm() < kNear_m && std::abs(off.heading_rad) < kNear_rad)
      ekf_.relocate(seen.sightings, *placed);
  }
  ++counts_.recovered;
  was_found();
}

void EkfEstimator::was_found() {
  lost_.was_found();
  search_.forget_images();
  recognition_.agreed();
}

std::unique_ptr<Estimator> make_ekf_estimator(const Rig& rig, const EkfSettings& settings, const MapStart& start,
                                              const HealthSettings& health,
                                              const RelocalisationSettings& relocalisation) {
  if (start.map != nullptr || rig.front_end != FrontEnd::colour)
    return std::make_unique<EkfEstimator>(rig, settings, start, health, relocalisation);
  auto begin = [=](const std::optional<Restart>& again) -> std::unique_ptr<RestartableEstimator> {
    auto filter = again ? std::make_unique<EkfEstimator>(rig, settings, *again, health, relocalisation)
                        : std::make_unique<EkfEstimator>(rig, settings, MapStart{}, health, relocalisation);
    if (names_landmarks(rig) || settings.unnamed.start_hypotheses < 2) return filter;
    return std::make_unique<EkfHypotheses>(std::move(filter), settings.unnamed.start_hypotheses);
  };
  if (!SecondStart::is_of_use(settings.centre)) return begin({});
  return std::make_unique<SecondStart>(std::move(begin), settings.centre.second_start_px);
}

std::optional<std::string_view> why_unfit_for_ekf(const MapSnapshot& map, const Rig& rig) {
  if (std::ranges::any_of(map.landmarks, &MapLandmark::has_height))
    return "its landmarks have heights, and estimator \"ekf\" maps the plane";
  return why_names_do_not_fit(map, rig);
}

/// On a map with too few landmarks a search would never end; among landmarks that are all alike it finds wrong poses.
bool EkfEstimator::is_searchable(std::span<const MapLandmark> landmarks) const {
  const auto is_other = [&](const MapLandmark& landmark) { return landmark.kind != landmarks.front().kind; };
  if (!has_names() && std::ranges::none_of(landmarks, is_other)) return false;
  return landmarks.size() >= as_size(std::max(settings_.relocation.bearings, 1));
}

bool EkfEstimator::is_worth_starting_from(const MapStart& start) const {
  return start.pose_known || start.asks_odometry || start.mode == MapMode::localise ||
         is_searchable(start.map->landmarks);
}

void EkfEstimator::start_from(const MapStart& start) {
  const MapSnapshot& map = *start.map;
  if (names_) names_->identities().restore(map.views, map.next_identity);
  may_search_ = start.mode == MapMode::localise || is_searchable(map.landmarks);
  begin_on(start);
}

void EkfEstimator::begin_at(const StartPose& pose) {
  if (pose.known || map_.empty())
    ekf_.inflate_robot(pose.moved);
  else if (may_search_)
    begin_search(pose.within);
  else
    begin_from_nothing();
}

void EkfEstimator::begin_from_nothing() {
  map_.forget_everything(ekf_);
  ekf_.place_robot({}, Eigen::Matrix3d::Zero());
  counts_ = {};
}

const BearingSet& FeatureNames::name(const BearingSet& image, std::span<const PlanarLandmark> landmarks,
                                     const Candidates& candidates, const PlanarView& view, bool pose_is_a_guess) {
  write_sighted(view.ekf(), candidates, beliefs_);
  beliefs_.anywhere = pose_is_a_guess;
  beliefs_.mapped.clear();
  for (const PlanarLandmark& landmark : landmarks) {
    IdentityBeliefs::Mapped& mapped = beliefs_.mapped.emplace_back();
    mapped.identity = landmark.identity;
    if (const auto predicted = view.predict_straight(landmark)) {
      mapped.azimuth_rad = predicted->azimuth_rad;
      mapped.variance_rad2 = predicted->variance_rad2;
    }
  }
  std::ranges::sort(beliefs_.mapped, std::less{}, &IdentityBeliefs::Mapped::identity);
  return identities_.name(image, beliefs_);
}

}  // namespace azimuth
