#pragma once
// Closed-form poses from the minimum number of directions.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// The pose from which two mapped landmarks are at given positions in the body frame. The vector between them
/// determines the heading, their midpoint the position. Nothing when two positions coincide.
std::optional<Pose2> pose_from_pair(const std::array<Eigen::Vector2d, 2>& p_map,
                                    const std::array<Eigen::Vector2d, 2>& p_body);

/// The pose from which three landmarks are seen in three directions (unit vectors in the body frame): three-point
/// resection as in surveying. Nothing when pose and landmarks are on one circle, or nearly so, or when a landmark would
/// have to be behind its direction.
std::optional<Pose2> pose_from_directions(const std::array<Eigen::Vector2d, 3>& p_map,
                                          const std::array<Eigen::Vector2d, 3>& to_landmark);

}  // namespace azimuth
