#include "slam/hindsight/named_mapper.hpp"

#include <limits>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr int kImagesBetweenChoices = 10;
constexpr int kJudgementsInGraph = 10;
// Factor on the rig's bearing noise beyond which identities, or all bearings, must be wrong
constexpr double kNoCamera = 5.0;
// Cost of an outlier: ln of the odds of a right identity, at zero residual, against a wrong one, with one wrong
// identity in twenty spread over all directions.
constexpr double kOfNothingCosts = 7.5;
constexpr double kBetterBy = 12.0;  // fall of the energy needed to change members; equal minima differ by rounding
constexpr double kHopelessBy = 20.0;

}  // namespace

NamedMapper::NamedMapper(const std::vector<KnownNamesSettings>& members, int established_after)
    : established_after_(as_size(established_after)) {
  for (const KnownNamesSettings& member : members) members_.emplace_back(member);
}

bool NamedMapper::remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) {
  for (KnownNames& member : members_) member.remember(map, moved);
  for (const MapLandmark& landmark : map.landmarks) ids_[landmark.identity] = {landmark.id, landmark.sightings};
  next_id_ = map.next_id;
  list_landmarks();
  return true;
}

void NamedMapper::predict(const Motion& motion) {
  for (KnownNames& member : members_) member.predict(motion);
}

UpdateOutcome NamedMapper::update(const BearingSet& set) {
  UpdateOutcome heard;
  const std::size_t known_before = ids_.size();
  for (KnownNames& member : members_) heard.used = member.update(set) || heard.used;
  heard.thinned = as_size(best().last_image().thinned);
  heard.recovered = as_size(best().last_image().reinitialised);
  if (heard.used && ++images_since_choice_ >= kImagesBetweenChoices) choose();
  if (best().is_full()) forget(best().least_worth());
  list_heard();
  list_landmarks();
  heard.created = ids_.size() - known_before;
  return heard;
}

/// Removes the same poses from all members, so that their energies stay comparable.
void NamedMapper::forget(const std::vector<PoseId>& poses) {
  for (KnownNames& member : members_) member.forget(poses);
}

/// Judges the rig from the whole graph. This is repeated when the graph has grown by a tenth.
void NamedMapper::judge_rig() {
  images_since_judged_ += kImagesBetweenChoices;
  if (kJudgementsInGraph * images_since_judged_ < smoother().graph().poses()) return;
  images_since_judged_ = 0;
  const RigBelief rig = best().judged_rig();
  for (KnownNames& member : members_) member.believe(rig);
}

std::optional<Judgement> NamedMapper::doubt() const {
  const RigBelief& rig = best().rig();
  if (rig.is_beyond_repair()) return kFitsNoRig;
  if (rig.bearing_noise > kNoCamera) return Judgement{Health::degraded, "bearings are too noisy for any camera"};
  return std::nullopt;
}

/// Chooses the member that gives the results. Members with a much higher energy become copies of the best one.
void NamedMapper::choose() {
  images_since_choice_ = 0;
  judge_rig();
  if (members_.size() < 2) return;
  std::vector<double> energies;
  for (const KnownNames& member : members_)
    energies.push_back(member.smoother().graph().bounded_energy(kOfNothingCosts));
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (energies[i] + kBetterBy < energies[best_]) best_ = i;
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (energies[i] > energies[best_] + kHopelessBy) members_[i].adopt(best());
}

void NamedMapper::return_to_bookmark() {
  if (bookmark_.empty()) return;
  members_ = bookmark_;
  heard_.clear();
  list_landmarks();
}

void NamedMapper::place(const PoseGaussian& robot) {
  for (KnownNames& member : members_) member.place(robot.T_map_body, robot.covariance);
  heard_.clear();
}

void NamedMapper::list_heard() {
  const BearingGraph& graph = smoother().graph();
  heard_.clear();
  for (BearingId id = best().last_image().first; id < graph.bearings(); ++id) {
    const LandmarkId landmark = graph.landmark_of(id);
    const BearingMeasurement& bearing = graph.bearing(id);
    const auto [name, is_new] = ids_.try_emplace(best().names()[as_size(landmark)], Name{next_id_, 0});
    next_id_ += is_new ? 1 : 0;
    heard_.push_back({.landmark_id = name->second.id,
                      .azimuth_rad = bearing.azimuth_rad,
                      .sigma_rad = bearing.sigma_rad,
                      .established = graph.is_known(landmark) || best().sightings(landmark) > established_after_,
                      .agrees = best().agrees(id)});
  }
}

void NamedMapper::list_landmarks() {
  landmarks_.clear();
  const BearingGraph& graph = smoother().graph();
  for (LandmarkId id = 0; id < graph.landmarks(); ++id) {
    if (!best().is_current(id)) continue;
    const Identity identity = best().names()[as_size(id)];
    const auto name = ids_.find(identity);
    if (name == ids_.end()) continue;  // seen only in discarded images
    landmarks_.push_back({.id = name->second.id,
                          .identity = identity,
                          .in_graph = id,
                          .sightings = name->second.sightings_before + best().sightings(id),
                          .recalled = graph.is_known(id)});
  }
}

void NamedMapper::conclude() { members_[best_].conclude(kIterationsToTheEnd); }

PoseGaussian NamedMapper::past(PoseNumber number) const {
  const ThinnedPath::Told told = best().past(number);
  return {told.T_map_body, told.covariance};
}

}  // namespace azimuth
