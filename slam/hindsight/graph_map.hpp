#pragma once
#include <span>

#include "slam/hindsight/mapper.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Sets the robot's pose and the landmarks of `out` to the graph's estimates, with their joint covariance. `in_graph`
/// has the graph's number of each landmark of `out`. The camera entries of `out` keep their covariance and become
/// uncorrelated with the rest. Returns false, with `out` unspecified, when the graph does not know one of them.
bool place_by_graph(const Mapper& mapper, std::span<const LandmarkId> in_graph, MapSnapshot& out);

}  // namespace azimuth
