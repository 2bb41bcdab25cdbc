// The removal of poses from a bearing graph.

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// Rebuilds the graph from the remaining poses.
void BearingGraph::forget(std::span<const PoseId> poses) {
  const BearingGraph before = *this;
  blocks_ = {};
  poses_ = {};
  odometry_ = {};
  bearings_ = {};
  links_ = {};
  elevations_ = {};
  stale_.clear();
  rows_ = 0;

  std::vector<PoseId> pose_now(static_cast<std::size_t>(before.poses()), 0);
  for (const PoseId id : poses) pose_now[static_cast<std::size_t>(id)] = kForgotten;
  assert(pose_now.front() != kForgotten && pose_now.back() != kForgotten);
  std::vector<BearingId> bearing_now(static_cast<std::size_t>(before.bearings()), kForgotten);
  std::optional<OdometryMeasurement> way;  // odometry through removed poses
  for (Block block = 0; block < before.blocks(); ++block) {
    const auto [kind, id, row] = before.blocks_[block];
    if (kind == Kind::calibration) {
      add_block(kind, id, calibration_size_);
    } else if (kind == Kind::landmark) {
      landmarks_.edit(id).block = add_block(kind, id, 2);
    } else if (kind == Kind::height) {
      heights_.edit(id).block = add_block(kind, id, 1);
    } else {
      const OdometryMeasurement& here = before.odometry_[id];
      const OdometryMeasurement whole = way ? composed(*way, here) : here;
      PoseId& now = pose_now[static_cast<std::size_t>(id)];
      if (now == kForgotten) {
        way = whole;
        continue;
      }
      now = poses_.size();
      keep_pose(before, id, way ? std::optional(whole) : std::nullopt, bearing_now);
      way.reset();
    }
  }
  for (LandmarkId id = 0; id < landmarks_.size(); ++id) {
    std::vector<BearingId>& bearings = landmarks_.edit(id).bearings;
    for (BearingId& bearing : bearings) bearing = bearing_now[static_cast<std::size_t>(bearing)];
    std::erase(bearings, kForgotten);
    bearings.shrink_to_fit();
    if (landmarks_[id].height == kNoHeight) continue;
    heights_.edit(landmarks_[id].height).elevations =
        static_cast<int>(std::ranges::count_if(bearings, [this](BearingId bearing) { return has_elevation(bearing); }));
  }
  if (!remembered_blocks_.empty()) keep_remembered(pose_now);
}

/// Appends a pose of `before`. `way` is the composed odometry when the pose before it was removed.
void BearingGraph::keep_pose(const BearingGraph& before, PoseId id, const std::optional<OdometryMeasurement>& way,
                             std::vector<BearingId>& bearing_now) {
  PoseEntry pose = before.poses_[id];
  const PoseId now = poses_.size();
  pose.block = add_block(Kind::pose, now, before.size(pose.block));
  pose.first_bearing = bearings_.size();
  pose.moved = pose.moved || way.has_value();
  poses_.push_back(pose);
  odometry_.push_back(way.value_or(before.odometry_[id]));
  for (BearingId bearing = before.poses_[id].first_bearing; bearing < before.end_of_bearings(id); ++bearing) {
    bearing_now[static_cast<std::size_t>(bearing)] = bearings_.size();
    BearingMeasurement measured = before.bearings_[bearing];
    measured.pose = now;
    if (measured.elevation != kNoElevation) {
      elevations_.push_back(before.elevations_[measured.elevation]);
      measured.elevation = elevations_.size() - 1;
    }
    bearings_.push_back(measured);
    links_.push_back(before.links_[bearing]);
  }
}

void BearingGraph::keep_remembered(const std::vector<PoseId>& pose_now) {
  if (const PoseId now = pose_now[static_cast<std::size_t>(remembered_->pose)]; now != remembered_->pose) {
    assert(now != kForgotten);
    Remembered known = *remembered_;
    known.pose = now;
    remembered_ = std::make_shared<const Remembered>(std::move(known));
  }
  list_remembered_blocks();
}

}  // namespace azimuth
