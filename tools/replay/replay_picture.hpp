#pragma once
#include "drivers/io/run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/plot/map_picture.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// The map of a replay in the map frame: truth comes in by the report's alignment, odometry starts where the first
/// estimate does.
MapPicture replay_picture(const Run& run, const ReplayResult& result, const Report& report);

}  // namespace azimuth
