#include "slam/hindsight/nameless_mapper.hpp"

#include <algorithm>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

NamelessMapper::NamelessMapper(const NamelessSettings& settings, std::unique_ptr<Workers> workers)
    : nameless_(settings), workers_(std::move(workers)) {}

bool NamelessMapper::remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) {
  if (!moved) return false;
  nameless_.remember(map, *moved);
  for (const MapLandmark& landmark : map.landmarks) remembered_.push_back({landmark.id, landmark.sightings});
  list_landmarks();
  return true;
}

UpdateOutcome NamelessMapper::update(const BearingSet& set) {
  UpdateOutcome heard;
  concluded_.reset();
  heard_.clear();
  heard.used = nameless_.update(set, *workers_);
  if (!heard.used) {
    heard.thinned = set.bearings.size();
    return heard;
  }
  if (nameless_.is_full()) forget();
  list_heard();
  list_landmarks();
  return heard;
}

void NamelessMapper::list_heard() {
  const Hypothesis& best = nameless_.beam().best();
  const BearingGraph& graph = best.graph();
  for (BearingId id = best.first_bearing(best.images() - 1); id < graph.bearings(); ++id) {
    const LandmarkId landmark = graph.landmark_of(id);
    if (landmark == kOfNothing) continue;
    const BearingMeasurement& bearing = graph.bearing(id);
    heard_.push_back({.landmark_id = known(landmark).id,
                      .azimuth_rad = wrap(bearing.azimuth_rad - calibration()[calibration::yaw]),
                      .sigma_rad = bearing.sigma_rad,
                      .established = true,
                      .agrees = true});
  }
}

void NamelessMapper::list_landmarks() {
  landmarks_.clear();
  for (const LandmarkId landmark : nameless_.beam().best().landmarks()) {
    const Known& of_it = known(landmark);
    landmarks_.push_back({.id = of_it.id,
                          .kind = nameless_.beam().best().kind_of(landmark),
                          .in_graph = landmark,
                          .sightings = of_it.forgotten_sightings + smoother().graph().bearings_of(landmark).size(),
                          .recalled = smoother().graph().is_known(landmark)});
  }
}

/// The number of the landmark's first bearing. Unlike landmark numbers, bearing numbers are common to all hypotheses.
std::int64_t NamelessMapper::first_bearing_of(LandmarkId landmark) const {
  const std::vector<BearingId>& bearings = smoother().graph().bearings_of(landmark);
  return nameless_.number_of(*std::ranges::min_element(bearings));
}

NamelessMapper::Known NamelessMapper::known(LandmarkId landmark) const {
  if (as_size(landmark) < remembered_.size()) return remembered_[as_size(landmark)];
  const std::int64_t first = first_bearing_of(landmark);
  const auto found = known_.find(first);
  return found == known_.end() ? Known{.id = first} : found->second;
}

/// Removes poses but keeps the ids of the best hypothesis's landmarks, even if another hypothesis is the best
/// afterwards. The ids are transferred by bearing numbers, which are common to all hypotheses.
void NamelessMapper::forget() {
  struct Before {
    LandmarkId landmark;
    Known known;
    std::vector<std::int64_t> bearings;
  };
  std::vector<Before> before;
  for (const LandmarkId landmark : nameless_.beam().best().landmarks()) {
    Before& was = before.emplace_back(Before{landmark, known(landmark), {}});
    for (const BearingId id : smoother().graph().bearings_of(landmark)) was.bearings.push_back(nameless_.number_of(id));
  }
  nameless_.forget(*workers_);
  for (Before& was : before) {
    const std::size_t all = was.bearings.size();
    std::erase_if(was.bearings, [&](std::int64_t number) { return !nameless_.has(number); });
    const Known now{was.known.id, was.known.forgotten_sightings + (all - was.bearings.size())};
    if (as_size(was.landmark) < remembered_.size())
      remembered_[as_size(was.landmark)] = now;
    else if (!was.bearings.empty())
      known_[*std::ranges::min_element(was.bearings)] = now;
  }
  std::erase_if(known_, [&](const auto& entry) { return !nameless_.has(entry.first); });
}

void NamelessMapper::place(const PoseGaussian& robot) {
  nameless_.place({robot.T_map_body, robot.covariance});
  heard_.clear();
}

PoseGaussian NamelessMapper::pose() const {
  const Beam::PoseBelief belief = nameless_.pose();
  return {belief.T_map_body, belief.covariance};
}

std::optional<RigBelief> NamelessMapper::rig() const {
  RigBelief rig;
  for (int i = 0; i < kCalibrations; ++i) rig.doubted[as_size(i)] = nameless_.rig_errors().is_contradicted(i);
  return rig.doubts_any() ? std::optional(rig) : std::nullopt;
}

std::optional<Judgement> NamelessMapper::doubt() const {
  if (nameless_.fits_no_rig()) return kFitsNoRig;
  const Trust trust = nameless_.trust();
  if (trust.trusted()) return std::nullopt;
  return Judgement{Health::degraded, trust.doubt};
}

/// Optimises the best hypothesis only. past() still uses all hypotheses.
void NamelessMapper::conclude() {
  concluded_ = smoother();
  concluded_->optimise(kIterationsToTheEnd);
}

PoseGaussian NamelessMapper::past(PoseNumber number) const {
  const Beam::PoseBelief belief = nameless_.past(number);
  return {belief.T_map_body, belief.covariance};
}

}  // namespace azimuth
