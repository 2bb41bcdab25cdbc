#include "slam/hindsight/named_mapper.hpp"

#include "slam/geometry/index.hpp"

namespace azimuth {

NamedMapper::NamedMapper(const KnownNamesSettings& settings, int established_after)
    : names_(settings), established_after_(as_size(established_after)) {}

bool NamedMapper::remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) {
  names_.remember(map, moved);
  for (const MapLandmark& landmark : map.landmarks) {
    ids_.push_back(landmark.id);
    recalled_.push_back(landmark.sightings);
  }
  next_id_ = map.next_id;
  list_landmarks();
  return true;
}

Heard NamedMapper::update(const BearingSet& set) {
  Heard heard;
  heard.used = names_.update(set);
  const KnownNames::LastImage& image = names_.last_image();
  heard.thinned = as_size(image.thinned);
  heard.created = as_size(image.planted + image.replanted);
  heard.deleted = heard.recovered = as_size(image.replanted);
  give_ids();
  list_heard();
  list_landmarks();
  return heard;
}

/// Identifiers that were given meanwhile are not given again.
void NamedMapper::return_to_bookmark() {
  if (!bookmark_) return;
  names_ = bookmark_->names;
  ids_ = bookmark_->ids;
  give_ids();
  heard_.clear();
  list_landmarks();
}

void NamedMapper::place(const PoseGaussian& robot) {
  names_.place(robot.T_map_body, robot.covariance);
  heard_.clear();
}

void NamedMapper::give_ids() {
  while (as_index(ids_.size()) < smoother().graph().landmarks()) ids_.push_back(next_id_++);
}

void NamedMapper::list_heard() {
  const BearingGraph& graph = smoother().graph();
  heard_.clear();
  for (BearingId id = names_.last_image().first; id < graph.bearings(); ++id) {
    const LandmarkId landmark = graph.landmark_of(id);
    const BearingMeasurement& bearing = graph.bearing(id);
    heard_.push_back({.landmark_id = ids_[as_size(landmark)],
                      .azimuth_rad = bearing.azimuth_rad,
                      .sigma_rad = bearing.sigma_rad,
                      .established = graph.is_known(landmark) || names_.sightings(landmark) > established_after_,
                      .agrees = names_.agrees(id)});
  }
}

void NamedMapper::list_landmarks() {
  landmarks_.clear();
  const BearingGraph& graph = smoother().graph();
  for (LandmarkId id = 0; id < graph.landmarks(); ++id) {
    if (!names_.is_current(id)) continue;
    const std::size_t at = as_size(id);
    const std::uint64_t before = at < recalled_.size() ? recalled_[at] : 0;
    landmarks_.push_back({.id = ids_[at],
                          .identity = names_.names()[at],
                          .in_graph = id,
                          .sightings = before + names_.sightings(id),
                          .recalled = graph.is_known(id)});
  }
}

PoseGaussian NamedMapper::past(PoseNumber number) const {
  const ThinnedPath::Told told = names_.past(number);
  return {told.T_map_body, told.covariance};
}

}  // namespace azimuth
