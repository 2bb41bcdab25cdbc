#pragma once
#include <string>
#include <vector>

#include "tools/drive_fit/drive_graph.hpp"
#include "tools/plot/bearing_residuals.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

/// Picture of the fitted path and map, with dead reckoning by the rig `said` and by the calibrated rig.
MapPicture drive_picture(const Drive& drive, const DriveSolution& solution, const Rig& said,
                         const HindsightSettings& settings, std::string title, std::string subtitle);

/// The residuals of all bearings with the path and map that fit `guess` best; `graph` gives the data association and
/// the starting point. Landmarks with two bearings are left out, because two rays always meet. Costs one solution of
/// the graph.
std::vector<PlottedResidual> residuals_with(const Drive& drive, const DriveGraph& graph, const RigGuess& guess,
                                            const HindsightSettings& settings);

}  // namespace azimuth
