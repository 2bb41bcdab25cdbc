#pragma once
#include <span>

#include "drivers/storage/run.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/plot/map_picture.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// Picture of a replay in the map frame. Truth is transformed with the report's alignment; odometry starts at the first
/// estimate. `classes` give names to the kinds of a colour front end, in order; other kinds have only numbers.
MapPicture replay_picture(const Run& run, const ReplayResult& result, const Report& report,
                          std::span<const ColourClass> classes = {});

}  // namespace azimuth
