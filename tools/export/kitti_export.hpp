#pragma once
#include <string>

#include "tools/export/estimated.hpp"

namespace azimuth {

/// A trajectory in the format of the KITTI odometry benchmark: one line per pose with the twelve numbers of [R | t],
/// row by row, without time. Axes are those of a camera that looks ahead at the robot's position: x to the right, y
/// down, z ahead. The map frame is rotated in the same way (its x axis becomes z, its y axis becomes -x), so that the
/// first line of a run without an initial map is the identity.
std::string kitti_text(const Estimated& estimated);

/// The times of the lines of kitti_text() in the format of the benchmark's times.txt: seconds since the first pose, one
/// per line.
std::string kitti_times(const Estimated& estimated);

}  // namespace azimuth
