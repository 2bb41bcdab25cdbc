#pragma once
// Conversion between a filter's state and a saved map.

#include <vector>

#include "slam/ekf/joint_state.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// First entry of the camera's estimated errors in the state, right after the robot's pose.
inline constexpr Index kCameraEntry = 3;

/// Writes pose, camera and landmarks of a map into a state that has no landmarks yet. Landmarks become points, with a
/// height where the map has one. The camera is not restored if the map does not have `camera_entries` camera entries.
/// Returns the points' blocks.
std::vector<Index> restore(const MapSnapshot& map, Index camera_entries, JointState& state);

/// Collects the landmarks of a state that are to be saved.
///
/// Thread contract: thread-bound. Nothing allocates once the map has had its largest size.
class StateSaver {
 public:
  void clear() { saved_.clear(); }
  /// Adds a landmark that is a point (point or point3) of the state in `block`; its position is taken from there.
  void add(Index block, BlockKind kind, const MapLandmark& landmark) { saved_.push_back({block, kind, landmark}); }
  bool empty() const { return saved_.empty(); }

  /// Writes pose, camera, landmarks in the order of their blocks, and their joint covariance. Leaves the rest of `out`
  /// alone.
  void write(const JointState& state, Index camera_entries, MapSnapshot& out);

 private:
  struct Saved {
    Index block;
    BlockKind kind;
    MapLandmark landmark;
  };
  std::vector<Saved> saved_;
  std::vector<Index> entries_;
};

}  // namespace azimuth
