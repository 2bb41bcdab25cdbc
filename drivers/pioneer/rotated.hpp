#pragma once
// Internal to drivers/pioneer.

#include "slam/geometry/pose2.hpp"

namespace azimuth::pioneer {

inline Eigen::Vector2d rotated(const Eigen::Vector2d& v, double angle_rad) { return Pose2{0.0, 0.0, angle_rad} * v; }

}  // namespace azimuth::pioneer
