#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/sample/map_snapshot.hpp"
#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// Puts a saved map of landmarks in the plane into a smoother that has nothing but its first pose: the map's frame is
/// the smoother's. Landmarks have the order of the map. What the map knows of its camera is not used.
///
/// With `moved` the robot is where the map saw it last, give or take so much (covariance of (x [m], y [m], heading
/// [rad])), at the newest pose; without, where it is nobody knows. Thread contract: reentrant.
std::vector<LandmarkId> remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved,
                                 Smoother& smoother);

}  // namespace azimuth
