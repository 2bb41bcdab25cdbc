#pragma once
#include <span>

#include "slam/hindsight/mapper.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Puts the robot and the landmarks of `out`, which are `in_graph` in their order, where the graph has them, with their
/// joint covariance. What `out` says of the camera keeps its own, and has nothing to do with the rest. False, with
/// `out` unspecified: the graph says nothing of one of them.
bool place_by_graph(const Mapper& mapper, std::span<const LandmarkId> in_graph, MapSnapshot& out);

}  // namespace azimuth
