#include "slam/hindsight/nameless_mapper.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {

NamelessMapper::NamelessMapper(const NamelessSettings& settings, std::unique_ptr<Workers> workers)
    : nameless_(settings), workers_(std::move(workers)) {}

Heard NamelessMapper::update(const BearingSet& set) {
  Heard heard;
  concluded_.reset();
  heard_.clear();
  heard.used = nameless_.update(set, *workers_);
  if (!heard.used) {
    heard.thinned = set.bearings.size();
    return heard;
  }
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
    heard_.push_back({.landmark_id = first_bearing_of(landmark),
                      .azimuth_rad = bearing.azimuth_rad,
                      .sigma_rad = bearing.sigma_rad,
                      .established = true,
                      .agrees = true});
  }
}

void NamelessMapper::list_landmarks() {
  landmarks_.clear();
  for (const LandmarkId id : nameless_.beam().best().landmarks())
    landmarks_.push_back(
        {.id = first_bearing_of(id), .in_graph = id, .sightings = smoother().graph().bearings_of(id).size()});
}

/// Numbers of bearings mean the same to all hypotheses, those of landmarks do not.
BearingId NamelessMapper::first_bearing_of(LandmarkId landmark) const {
  const std::vector<BearingId>& bearings = smoother().graph().bearings_of(landmark);
  return *std::min_element(bearings.begin(), bearings.end());
}

PoseGaussian NamelessMapper::pose() const {
  const Beam::PoseBelief belief = nameless_.pose();
  return {belief.T_map_body, belief.covariance};
}

std::optional<Judgement> NamelessMapper::doubt() const {
  const Trust trust = nameless_.trust();
  if (trust.trusted()) return std::nullopt;
  return Judgement{Health::degraded, trust.doubt};
}

/// The others go on saying what may be true of the past instead: past() tells what all of them do.
void NamelessMapper::conclude() {
  concluded_ = smoother();
  concluded_->optimise(kIterationsToTheEnd);
}

PoseGaussian NamelessMapper::past(PoseNumber number) const {
  const Beam::PoseBelief belief = nameless_.beam().pose(number);
  return {belief.T_map_body, belief.covariance};
}

}  // namespace azimuth
