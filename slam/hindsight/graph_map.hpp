#pragma once
#include <Eigen/Core>
#include <span>

#include "slam/hindsight/mapper.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Covariance that an error in the scale of all distances adds to a position; `sigma_scale` is the standard deviation
/// of the scale. Bearings cannot reveal this error: a larger map with a longer path gives the same bearings. The error
/// moves each position away from the map's origin in proportion to its distance.
inline Eigen::Matrix2d by_scale(double sigma_scale, const Eigen::Vector2d& p_map) {
  return sigma_scale * sigma_scale * p_map * p_map.transpose();
}

/// Sets the robot's pose and the landmarks of `out` to the graph's estimates, with their joint covariance. `in_graph`
/// has the graph's number of each landmark of `out`. The camera entries of `out` keep their covariance and become
/// uncorrelated with the rest. Returns false, with `out` unspecified, when the graph does not know one of them.
bool place_by_graph(const Mapper& mapper, std::span<const LandmarkId> in_graph, MapSnapshot& out);

}  // namespace azimuth
