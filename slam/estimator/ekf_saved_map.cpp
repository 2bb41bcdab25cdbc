// EkfEstimator: the map as it is saved, and how one begins from it.

#include <algorithm>
#include <utility>

#include "slam/estimator/ekf_estimator.hpp"
#include "slam/estimator/make_estimator.hpp"

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

/// To go on with a map too small to be searched would be to search for ever; among landmarks that are all alike a
/// search finds wrong places.
bool EkfEstimator::is_searchable(std::span<const MapLandmark> landmarks) const {
  const auto is_other = [&](const MapLandmark& landmark) { return landmark.kind != landmarks.front().kind; };
  if (!has_names() && std::ranges::none_of(landmarks, is_other)) return false;
  return landmarks.size() >= static_cast<std::size_t>(std::max(settings_.relocation_bearings, 1));
}

bool EkfEstimator::is_worth_starting_from(const MapStart& start) const {
  return start.pose_known || start.asks_odometry || start.mode == MapMode::localise ||
         is_searchable(start.map->landmarks);
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
                          .last_used = kLongAgo,
                          .recalled = true});
  }
  next_id_ = map.next_id;
  if (identities_) identities_->restore(map.views, map.next_identity);
  mode_ = start.mode;
  may_search_ = mode_ == MapMode::localise || is_searchable(map.landmarks);
  if (mode_ == MapMode::localise) ekf_.hold_map();
  if (start.asks_odometry)
    undecided_ = start_pose(start);
  else
    begin_at(start_pose(start));
}

void EkfEstimator::begin_at(const StartPose& pose) {
  if (pose.known || landmarks_.empty())
    ekf_.inflate_robot(pose.moved);
  else if (may_search_)
    begin_search(pose.within);
  else
    begin_from_nothing();
}

void EkfEstimator::begin_from_nothing() {
  while (!landmarks_.empty()) remove_landmark(landmarks_.size() - 1);
  ekf_.place_robot({}, Eigen::Matrix3d::Zero());
  counts_ = {};
}

bool EkfEstimator::odometry_begins(bool goes_on) {
  const std::optional<StartPose> pose = std::exchange(undecided_, std::nullopt);
  if (pose && !goes_on) begin_at(*pose);
  return pose && goes_on;
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
