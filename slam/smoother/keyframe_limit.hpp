#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// The constraints on the poses that a graph may remove.
struct ThinningRule {
  std::size_t newest_kept = 300;  ///< number of newest poses that are kept
  /// Number of oldest poses that are kept, at least one: they tie the map to its frame
  std::size_t oldest_kept = 1;
  std::size_t fewest_bearings = 6;  ///< minimum number of fitting bearings that each landmark keeps
};

/// The poses, at most `count`, that contribute least information (mathematics VI.24), ascending. There are fewer when
/// landmarks need the others. `numbers` has the number in the order of arrival of each pose. The graph must be as of
/// its last evaluate().
///
/// Thread contract: reentrant.
std::vector<PoseId> least_worth(const BearingGraph& graph, std::span<const std::int32_t> numbers, std::size_t count,
                                const ThinningRule& rule);

/// The limit on the number of poses of a graph, and the choice of poses to remove beyond it (mathematics VI.24).
///
/// Thread contract: thread-bound.
class KeyframeLimit {
 public:
  /// `max_poses` 0: no limit. Each landmark keeps at least `fewest_bearings` bearings that fit.
  explicit KeyframeLimit(int max_poses, std::size_t fewest_bearings = 6);

  /// Whether poses should be removed. The caller then calls BearingGraph::forget() and forgotten().
  bool is_exceeded(const BearingGraph& graph) const { return graph.poses() > most_; }
  /// The least valuable poses, ascending. Their number is such that the limit is not exceeded again at once; it is
  /// smaller, possibly zero, when landmarks need the poses. `numbers` has the number in the order of arrival of each
  /// pose.
  std::vector<PoseId> least_worth(const BearingGraph& graph, std::span<const std::int32_t> numbers) const;
  /// Must be called after poses were removed. If landmarks need more poses than the limit, the limit is raised until
  /// the graph has grown again.
  void forgotten(const BearingGraph& graph);

 private:
  int at_a_time() const;

  int max_poses_;
  std::size_t fewest_bearings_;
  PoseId most_;  ///< number of poses beyond which some are removed
};

}  // namespace azimuth
