#pragma once
// A filter's state as a map that outlives it, and the way back.

#include <vector>

#include "slam/ekf/joint_state.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Entry of the state from which on a filter keeps what it estimates of its camera, right after the robot's pose.
inline constexpr Index kCameraEntry = 3;

/// Puts what a map says of pose, camera and landmarks into a state that has none yet; landmarks become points, with a
/// height where the map has one. The camera is left as it is when the map's filter estimated something else of it than
/// `camera_entries` entries. Returns the points' blocks.
std::vector<Index> restore(const MapSnapshot& map, Index camera_entries, JointState& state);

/// Collects the landmarks of a state that are to be saved.
///
/// Thread contract: thread-bound. Nothing allocates once the map has had its largest size.
class StateSaver {
 public:
  void clear() { saved_.clear(); }
  /// A landmark that is a point of the state (point or point3) in `block`; its place is taken from there.
  void add(Index block, BlockKind kind, const MapLandmark& landmark) { saved_.push_back({block, kind, landmark}); }
  bool empty() const { return saved_.empty(); }

  /// Pose, camera, landmarks in the order of their blocks, and the joint covariance of all; the rest is left as it is.
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
