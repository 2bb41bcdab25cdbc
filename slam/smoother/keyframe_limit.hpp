#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// How many poses a graph may have, and which are to be forgotten when there are more (SPEC VI.24).
///
/// Thread contract: thread-bound.
class KeyframeLimit {
 public:
  /// 0: as many as come. No landmark is left with fewer bearings that fit.
  explicit KeyframeLimit(int max_poses, std::size_t fewest_bearings = 6);

  /// BearingGraph::forget() is to follow, and forgotten().
  bool is_exceeded(const BearingGraph& graph) const { return graph.poses() > most_; }
  /// Those worth least, ascending: so many that it is some time until there are too many again, fewer or none when
  /// landmarks need them. `numbers`: of all poses, when each arrived.
  std::vector<PoseId> least_worth(const BearingGraph& graph, std::span<const std::int32_t> numbers) const;
  /// Where landmarks need so many poses that few can be forgotten, it is time again when there are that many more.
  void forgotten(const BearingGraph& graph);

 private:
  int at_a_time() const;

  int max_poses_;
  std::size_t fewest_bearings_;
  PoseId most_;  ///< before some have to be forgotten
};

}  // namespace azimuth
