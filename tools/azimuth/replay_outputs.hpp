#pragma once
// What subcommands that replay a run make of the outcome.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "slam/sample/map_snapshot.hpp"
#include "tools/azimuth/exports.hpp"
#include "tools/azimuth/html_output.hpp"
#include "tools/azimuth/replay_run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// Files to write. Empty: not asked for.
struct ReplayOutputs {
  std::filesystem::path report, plot, tum, tum_smoothed, map;
  std::string name;               ///< of the run, in the report
  std::vector<std::string> tags;  ///< likewise
  ExportWishes exports;
  HtmlWishes html;  ///< of all runs together: see HtmlOutput

  std::vector<std::filesystem::path> files() const { return {report, plot, tum, tum_smoothed, map}; }
};

/// Refuses and fails before the run, which may take long.
void check_outputs(const ReplayOutputs& outputs);

/// Which poses are exported.
enum class ExportedPoses : std::uint8_t {
  as_they_came,  ///< those of the steps, as they were known then
  refined,       ///< as they are known at the end
};

/// Adds --report, --name and --tag.
void add_report_options(CLI::App& command, ReplayOutputs& outputs, const std::string& report_help);

/// The outcome beside the run, judged. `estimator` is what the report calls it.
Report report_of(const ReplaySetup& setup, const ReplayResult& result, std::string_view estimator,
                 const ReplayOutputs& outputs);

/// All that were asked for. A map there must be.
void write_outputs(const ReplaySetup& setup, const ReplayResult& result, const Report& report,
                   const ReplayOutputs& outputs, ExportedPoses exported = ExportedPoses::as_they_came);

/// Fails where it could not be started from. How many bytes it takes.
std::size_t write_map_file(const MapSnapshot& map, const std::filesystem::path& file);

/// Refuses a run from which nothing came, and throws kEndsLost for one which ends where nobody knows: neither must pass
/// for a good one.
void judge_end(const ReplayOptions& options, const ReplayResult& result, const Report& report);

}  // namespace azimuth
