#include "slam/ekf/saved_state.hpp"

#include <algorithm>
#include <cassert>

#include "slam/ekf/considered_rig.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

static_assert(kCameraEntry == JointState::kPose + size_of(BlockKind::pose));

Index add_point(const MapLandmark& landmark, JointState& state) {
  const Eigen::Vector2d& p = landmark.p_map_landmark_m;
  if (!landmark.has_height()) return state.add(BlockKind::point, p);
  return state.add(BlockKind::point3, Eigen::Vector3d(p.x(), p.y(), landmark.z_map_landmark_m));
}

/// The map was made with this odometer and camera, starting at the origin.
void restore_considered(const std::vector<Index>& blocks, JointState& state) {
  set_of_placed_robot(state);
  for (const Index block : blocks) set_of_place(block, state);
}

}  // namespace

std::vector<Index> restore(const MapSnapshot& map, Index camera_entries, JointState& state) {
  assert(state.extent() == kCameraEntry + camera_entries);
  std::vector<Index> entries, blocks;
  for (Index i = 0; i < kCameraEntry; ++i) {
    state.set_mean(i, map.T_map_body.vector()(i));
    entries.push_back(i);
  }
  const bool same_camera = as_index(map.camera.size()) == camera_entries;
  for (const double value : map.camera) {
    entries.push_back(same_camera ? as_index(entries.size()) : JointState::kNoEntry);
    if (same_camera) state.set_mean(entries.back(), value);
  }
  for (const MapLandmark& landmark : map.landmarks) {
    blocks.push_back(add_point(landmark, state));
    for (Index i = 0; i < as_index(landmark.size()); ++i) entries.push_back(blocks.back() + i);
  }
  state.set_covariance(entries, map.covariance);
  restore_considered(blocks, state);
  return blocks;
}

void StateSaver::write(const JointState& state, Index camera_entries, MapSnapshot& out) {
  std::ranges::sort(saved_, std::less{}, &Saved::block);
  out.T_map_body = state.pose();
  entries_.clear();
  for (Index i = 0; i < kCameraEntry + camera_entries; ++i) {
    if (i >= kCameraEntry) out.camera.push_back(state.mean(i));
    entries_.push_back(i);
  }
  for (const Saved& saved : saved_) {
    MapLandmark& landmark = out.landmarks.emplace_back(saved.landmark);
    landmark.p_map_landmark_m = state.position(saved.block);
    if (saved.kind == BlockKind::point3) landmark.z_map_landmark_m = state.mean(saved.block + 2);
    for (Index i = 0; i < size_of(saved.kind); ++i) entries_.push_back(saved.block + i);
  }
  state.covariance(entries_, out.covariance);
}

}  // namespace azimuth
