#pragma once
#include <string>

#include "tools/export/estimated.hpp"

namespace azimuth {

/// A trajectory as the odometry benchmark of KITTI has it: a line for each pose with the twelve numbers of [R | t], row
/// by row, and no time. Axes are those of a camera that looks ahead, at the robot's place: x to the right, y down, z
/// ahead; the frame is the map's, turned alike (its x axis is z, its y axis is -x). So the first line of a run that
/// began its map is the identity.
std::string kitti_text(const Estimated& estimated);

/// The times of those lines, as times.txt of that benchmark has them: seconds since the first pose, one a line.
std::string kitti_times(const Estimated& estimated);

}  // namespace azimuth
