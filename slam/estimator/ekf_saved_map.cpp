// EkfEstimator: the map as it is saved, and how one begins from it.

#include <algorithm>

#include "slam/estimator/ekf_estimator.hpp"
#include "slam/estimator/make_estimator.hpp"

namespace azimuth {
namespace {

// Before every stamp, and far enough from their limits to reckon with.
constexpr Stamp kLongAgo = stamp_from_us(std::numeric_limits<std::int64_t>::min() / 4);

/// Of independent coordinates.
Eigen::Matrix3d pose_covariance(double sigma_position_m, double sigma_heading_rad) {
  return Eigen::Vector3d(sigma_position_m, sigma_position_m, sigma_heading_rad).cwiseAbs2().asDiagonal();
}

MapNames names_of(const Rig& rig) {
  if (rig.camera.identities) return MapNames::sensor;
  return rig.front_end == FrontEnd::sift ? MapNames::looks : MapNames::none;
}

}  // namespace

std::string_view why_unfit_for_ekf(const MapSnapshot& map, const Rig& rig) {
  if (std::ranges::any_of(map.landmarks, &MapLandmark::has_height))
    return "its landmarks have heights, and estimator \"ekf\" maps the plane";
  if (map.names == names_of(rig)) return "";
  switch (map.names) {
    case MapNames::none:
      return "its landmarks have no names, and the rig's camera tells them apart by name or looks";
    case MapNames::sensor:
      return "its landmarks have names, which the rig's camera cannot read";
    case MapNames::looks:
      return "its landmarks are known by their looks, which the rig's front end does not see";
  }
  return "it is of a kind unknown here";
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
    begin_search();
  else
    ekf_.inflate_robot(pose_covariance(start.sigma_position_m, start.sigma_heading_rad));
}

/// Only points are saved: what is not one yet has been seen from too few places to be worth it.
bool EkfEstimator::save_map(MapSnapshot& out) const {
  out.clear();
  const JointState& state = ekf_.state();
  if (judged(state.pose_covariance(), path_m_).health == Health::lost) return false;
  saved_.clear();
  for (const Landmark& landmark : landmarks_)
    if (landmark.block_kind == BlockKind::point) saved_.push_back(&landmark);
  if (saved_.empty()) return false;
  std::ranges::sort(saved_, std::less{}, &Landmark::block);
  out.T_map_body = state.pose();
  saved_entries_.clear();
  for (Index i = 0; i < BearingEkf::kCamera + ekf_.camera_entries(); ++i) {
    if (i >= BearingEkf::kCamera) out.camera.push_back(state.mean(i));
    saved_entries_.push_back(i);
  }
  for (const Landmark* landmark : saved_) {
    out.landmarks.push_back({.id = landmark->id,
                             .identity = landmark->identity,
                             .kind = landmark->kind,
                             .sightings = landmark->sightings,
                             .p_map_landmark_m = state.position(landmark->block)});
    for (const Index i : {0, 1}) saved_entries_.push_back(landmark->block + i);
    if (identities_) identities_->store().save(landmark->identity, out.views);
  }
  state.covariance(saved_entries_, out.covariance);
  out.names = names_of(rig_);
  out.next_id = next_id_;
  out.next_identity = identities_ ? identities_->next() : 0;
  return true;
}

}  // namespace azimuth
