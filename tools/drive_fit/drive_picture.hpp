#pragma once
#include <string>

#include "tools/drive_fit/drive_graph.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

/// Path and map as they were fitted, beside odometry as `said` has it and as it was found to be.
MapPicture drive_picture(const Drive& drive, const DriveSolution& solution, const Rig& said,
                         const HindsightSettings& settings, std::string title, std::string subtitle);

}  // namespace azimuth
