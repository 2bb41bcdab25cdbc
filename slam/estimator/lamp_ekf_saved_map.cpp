// LampEkfEstimator: the map as it is saved, and how one begins from it.

#include <algorithm>
#include <utility>

#include "slam/estimator/lamp_ekf_estimator.hpp"
#include "slam/estimator/make_estimator.hpp"

namespace azimuth {

std::string_view why_unfit_for_lamp_ekf(const MapSnapshot& map, const Rig& rig) {
  if (!std::ranges::all_of(map.landmarks, &MapLandmark::has_height))
    return "its landmarks have no heights, and estimator \"lamp_ekf\" maps in space";
  return why_names_do_not_fit(map, rig);
}

void LampEkfEstimator::start_from(const MapStart& start) {
  const MapSnapshot& map = *start.map;
  const std::vector<Index> blocks = ekf_.restore(map);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const MapLandmark& saved = map.landmarks[i];
    const double log_odds = log_seen_ * static_cast<double>(saved.sightings);
    lamps_.push_back({.id = saved.id,
                      .identity = saved.identity,
                      .at = {blocks[i], BlockKind::point3},
                      .sightings = saved.sightings,
                      .log_odds = std::clamp(log_odds, 0.0, settings_.most_log_odds),
                      .evidence = LampEvidence::certain(),
                      .confirmed = true});
  }
  next_id_ = map.next_id;
  mode_ = start.mode;
  if (mode_ == MapMode::localise) ekf_.hold_map();
  if (start.asks_odometry)
    undecided_ = start_pose(start);
  else
    begin_at(start_pose(start));
}

void LampEkfEstimator::begin_at(const StartPose& pose) {
  if (pose.known || lamps_.empty())
    ekf_.inflate_robot(pose.moved);
  else
    begin_search(pose.within);
}

bool LampEkfEstimator::odometry_begins(bool goes_on) {
  const std::optional<StartPose> pose = std::exchange(undecided_, std::nullopt);
  if (pose && !goes_on) begin_at(*pose);
  return pose && goes_on;
}

/// Only points that are no longer on probation: the rest has been seen from too few places to be worth it.
bool LampEkfEstimator::save_map(MapSnapshot& out) const {
  out.clear();
  if (judged(ekf_.state().pose_covariance(), path_m_).health == Health::lost) return false;
  saver_.clear();
  for (const Lamp& lamp : lamps_)
    if (lamp.confirmed && lamp.at.kind == BlockKind::point3)
      saver_.add(lamp.at.block, lamp.at.kind, {.id = lamp.id, .identity = lamp.identity, .sightings = lamp.sightings});
  if (saver_.empty()) return false;
  saver_.write(ekf_.state(), ekf_.camera_entries(), out);
  out.names = names_of(rig_);
  out.next_id = next_id_;
  return true;
}

}  // namespace azimuth
