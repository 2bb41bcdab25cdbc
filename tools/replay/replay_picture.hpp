#pragma once
#include <span>

#include "drivers/storage/run.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/plot/map_picture.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// The map of a replay in the map frame: truth comes in by the report's alignment, odometry starts where the first
/// estimate does. `classes` name the kinds of a colour front end, in their order; other kinds have numbers only.
MapPicture replay_picture(const Run& run, const ReplayResult& result, const Report& report,
                          std::span<const ColourClass> classes = {});

}  // namespace azimuth
