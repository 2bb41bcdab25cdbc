#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// Which poses a graph may forget.
struct ThinningRule {
  std::size_t newest_kept = 300;    ///< of poses: these stay
  std::size_t oldest_kept = 1;      ///< likewise, at least one: the first ones say how the map lies in its frame
  std::size_t fewest_bearings = 6;  ///< of a landmark, that fit: it is not left with less
};

/// The poses, so many at most, that are worth least of what is known (SPEC VI.24), ascending; fewer when landmarks need
/// those that are left. `numbers`: of all poses, when each arrived. The graph must be as of its last evaluate().
///
/// Thread contract: reentrant.
std::vector<PoseId> least_worth(const BearingGraph& graph, std::span<const std::int32_t> numbers, std::size_t count,
                                const ThinningRule& rule);

}  // namespace azimuth
