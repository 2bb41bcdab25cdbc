#pragma once
#include <string>

#include "drivers/io/run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// The report for a reader: a line a topic, only topics that were measured.
std::string summary(const Run& run, const ReplayResult& result, const Report& report);

/// The part of it that judges poses, also of a trajectory made by others.
std::string pose_summary(const Report& report);

}  // namespace azimuth
