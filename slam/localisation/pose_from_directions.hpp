#pragma once
// The fewest directions that fix a pose, in closed form.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// The pose that sees two landmarks at known places in its own frame: the directions decide the heading, and the
/// middle between the landmarks is where it should be. Nothing when either pair is one place.
std::optional<Pose2> pose_from_pair(const std::array<Eigen::Vector2d, 2>& p_map,
                                    const std::array<Eigen::Vector2d, 2>& p_body);

/// The pose that sees three landmarks in three directions (unit vectors in its frame): the three-point resection of
/// surveyors. Nothing when all four lie on one circle, or nearly so, or when a landmark would have to be seen
/// backwards.
std::optional<Pose2> pose_from_directions(const std::array<Eigen::Vector2d, 3>& p_map,
                                          const std::array<Eigen::Vector2d, 3>& to_landmark);

}  // namespace azimuth
