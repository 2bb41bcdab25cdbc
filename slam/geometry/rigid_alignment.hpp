#pragma once
#include <Eigen/Core>
#include <span>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Returns T_to_from: the rotation and translation (no scale) that bring `from` closest to `to` in the least-squares
/// sense. Points correspond by index; both spans must have the same size. Fewer than two points give a translation
/// only.
Pose2 align(std::span<const Eigen::Vector2d> from, std::span<const Eigen::Vector2d> to);

}  // namespace azimuth
