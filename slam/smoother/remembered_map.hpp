#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/sample/map_snapshot.hpp"
#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// Puts a saved map of landmarks in the plane into a smoother that has only its first pose. The map's frame becomes the
/// smoother's frame. The returned landmarks are in the map's order. The map's camera calibration is not used.
///
/// With `moved`, the newest pose gets the robot's pose in the map as its prior, with the saved covariance plus `moved`
/// (covariance of (x [m], y [m], heading [rad])). Without `moved`, the robot's pose in the map is unknown. Thread
/// contract: reentrant.
std::vector<LandmarkId> remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved,
                                 Smoother& smoother);

}  // namespace azimuth
