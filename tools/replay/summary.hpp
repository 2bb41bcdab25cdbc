#pragma once
#include <string>
#include <string_view>

#include "drivers/storage/run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// The report as text for the user: one line per measured topic, then a verdict in one sentence and the one command to
/// go on with, in which `run_path` names the run. `refined`: the poses are those of `azimuth map refine`.
std::string summary(const Run& run, const ReplayResult& result, const Report& report, std::string_view run_path = "RUN",
                    bool refined = false);

/// Number of landmarks at the end, and number of those accurate enough for a saved map. Example: "24 landmarks, 22 of
/// them settled".
std::string landmark_counts(const Report& report);

/// The part of the summary on poses, also for trajectories of other programs.
std::string pose_summary(const Report& report);

}  // namespace azimuth
