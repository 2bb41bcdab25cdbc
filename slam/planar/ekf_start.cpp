// EkfEstimator: start from a saved map.

#include <algorithm>

#include "slam/geometry/index.hpp"
#include "slam/planar/ekf_estimator.hpp"
#include "slam/planar/make_ekf_estimator.hpp"

namespace azimuth {

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

}  // namespace azimuth
