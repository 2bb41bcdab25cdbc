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

}  // namespace azimuth
