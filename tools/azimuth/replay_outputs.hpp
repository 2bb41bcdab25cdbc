#pragma once
// What subcommands that replay a run make of the outcome.

#include <filesystem>
#include <vector>

#include "slam/sample/map_snapshot.hpp"
#include "tools/azimuth/replay_run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// Files to write. Empty: not asked for.
struct ReplayOutputs {
  std::filesystem::path report, plot, tum, tum_smoothed, map;

  std::vector<std::filesystem::path> files() const { return {report, plot, tum, tum_smoothed, map}; }
};

/// Refuses and fails before the run, which may take long.
void check_outputs(const ReplayOutputs& outputs);

/// The outcome beside the run, judged. `estimator` is what the report calls it.
Report report_of(const ReplaySetup& setup, const ReplayResult& result, std::string_view estimator);

/// All that were asked for. A map there must be.
void write_outputs(const ReplaySetup& setup, const ReplayResult& result, const Report& report,
                   const ReplayOutputs& outputs);

/// Fails where it could not be started from. How many bytes it takes.
std::size_t write_map_file(const MapSnapshot& map, const std::filesystem::path& file);

/// Refuses a run from which nothing came, and throws kEndsLost for one which ends where nobody knows: neither must pass
/// for a good one.
void judge_end(const ReplayOptions& options, const ReplayResult& result, const Report& report);

}  // namespace azimuth
