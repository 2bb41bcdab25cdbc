#pragma once
#include <string>

#include "tools/drive_fit/drive_graph.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

/// Picture of the fitted path and map, with dead reckoning by the rig `said` and by the calibrated rig.
MapPicture drive_picture(const Drive& drive, const DriveSolution& solution, const Rig& said,
                         const HindsightSettings& settings, std::string title, std::string subtitle);

}  // namespace azimuth
