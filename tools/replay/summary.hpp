#pragma once
#include <string>
#include <string_view>

#include "drivers/storage/run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// The report for a reader: a line a topic, only topics that were measured. It ends with what to do next where the run
/// contradicts itself or its rig; `run_path` is what to call the run by there.
std::string summary(const Run& run, const ReplayResult& result, const Report& report,
                    std::string_view run_path = "RUN");

/// How many landmarks there are at the end, and how many of them are known well enough for a saved map to keep them:
/// "24 landmarks, 22 of them settled".
std::string landmark_counts(const Report& report);

/// The part of it that judges poses, also of a trajectory made by others.
std::string pose_summary(const Report& report);

}  // namespace azimuth
