// EkfEstimator: the map as it is saved, and how one begins from it.

#include <algorithm>

#include "slam/estimator/ekf_estimator.hpp"
#include "slam/estimator/make_estimator.hpp"
#include "slam/estimator/map_fitness.hpp"

namespace azimuth {
namespace {

// Before every stamp, and far enough from their limits to reckon with.
constexpr Stamp kLongAgo = stamp_from_us(std::numeric_limits<std::int64_t>::min() / 4);

}  // namespace

std::string_view why_unfit_for_ekf(const MapSnapshot& map, const Rig& rig) {
  if (std::ranges::any_of(map.landmarks, &MapLandmark::has_height))
    return "its landmarks have heights, and estimator \"ekf\" maps the plane";
  return why_names_do_not_fit(map, rig);
}

bool EkfEstimator::is_worth_starting_from(const MapStart& start) const {
  if (start.pose_known || start.mode == MapMode::localise) return true;
  return start.map->landmarks.size() >= static_cast<std::size_t>(std::max(settings_.relocation_bearings, 1));
}

void EkfEstimator::start_from(const MapStart& start) {
  const MapSnapshot& map = *start.map;
  const std::vector<Index> blocks = ekf_.restore(map);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const MapLandmark& saved = map.landmarks[i];
    landmarks_.push_back({.id = saved.id,
                          .identity = saved.identity,
                          .kind = saved.kind,
                          .block = blocks[i],
                          .sightings = saved.sightings,
                          .last_used = kLongAgo});
  }
  next_id_ = map.next_id;
  if (identities_) identities_->restore(map.views, map.next_identity);
  mode_ = start.mode;
  if (mode_ == MapMode::localise) ekf_.hold_map();
  if (!start.pose_known && !landmarks_.empty())
    begin_search(whereabouts(start));
  else
    ekf_.inflate_robot(moved_since(start));
}

/// Only points are saved: what is not one yet has been seen from too few places to be worth it.
bool EkfEstimator::save_map(MapSnapshot& out) const {
  out.clear();
  const JointState& state = ekf_.state();
  if (judged(state.pose_covariance(), path_m_).health == Health::lost) return false;
  saver_.clear();
  for (const Landmark& landmark : landmarks_)
    if (landmark.block_kind == BlockKind::point)
      saver_.add(
          landmark.block, BlockKind::point,
          {.id = landmark.id, .identity = landmark.identity, .kind = landmark.kind, .sightings = landmark.sightings});
  if (saver_.empty()) return false;
  saver_.write(state, ekf_.camera_entries(), out);
  if (identities_)
    for (const MapLandmark& landmark : out.landmarks) identities_->store().save(landmark.identity, out.views);
  out.names = names_of(rig_);
  out.next_id = next_id_;
  out.next_identity = identities_ ? identities_->next() : 0;
  return true;
}

}  // namespace azimuth
