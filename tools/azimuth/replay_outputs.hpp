#pragma once
// The outputs of a replay, shared by the subcommands that replay a run.

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

/// Files to write. An empty path is not written.
struct ReplayOutputs {
  std::filesystem::path report, plot, tum, tum_smoothed, map;
  std::string name;               ///< name of the run in the report
  std::vector<std::string> tags;  ///< tags of the run in the report
  ExportWishes exports;
  HtmlWishes html;  ///< one page of all runs, see HtmlOutput

  std::vector<std::filesystem::path> files() const { return {report, plot, tum, tum_smoothed, map}; }
};

/// Refuses or fails before the replay, which may take long, if an output cannot be written.
void check_outputs(const ReplayOutputs& outputs);

/// Which poses are exported.
enum class ExportedPoses : std::uint8_t {
  as_they_came,  ///< the poses as they were known at each step
  refined,       ///< the poses as they are known at the end
};

/// Adds --report, --name and --tag.
void add_report_options(CLI::App& command, ReplayOutputs& outputs, const std::string& report_help);

/// Judges the result of a replay. The report names the estimator `estimator`.
Report report_of(const ReplaySetup& setup, const ReplayResult& result, std::string_view estimator,
                 const ReplayOutputs& outputs);

/// Writes all requested outputs. Fails if a map is requested but there is none.
void write_outputs(const ReplaySetup& setup, const ReplayResult& result, const Report& report,
                   const ReplayOutputs& outputs, ExportedPoses exported = ExportedPoses::as_they_came);

/// Writes the map and returns its size [bytes]. Fails if no estimator could start from the map.
std::size_t write_map_file(const MapSnapshot& map, const std::filesystem::path& file);

/// Refuses a run without a step or without a used bearing, and throws kEndsLost for a run that ends lost, so that
/// neither passes for a good run.
void judge_end(const ReplayOptions& options, const ReplayResult& result, const Report& report);

}  // namespace azimuth
