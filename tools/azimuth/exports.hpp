#pragma once
// What subcommands share that export what was estimated.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/export/estimated.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// As the command line gives them.
struct ExportWishes {
  std::vector<std::string> files;  ///< FILE, or FORMAT:FILE
  std::string origin;              ///< of the map, for GeoJSON; empty: nobody knows
};

/// Adds --export, which may be repeated, and --origin.
void add_export_options(CLI::App& command, ExportWishes& wishes);
/// Adds --origin alone.
void add_origin_option(CLI::App& command, ExportWishes& wishes);

/// Refuses what is no format, and fails where a file could not be written.
void check_exports(const ExportWishes& wishes);

/// On standard error, what the owner may not expect of them.
void tell_of_exports(const ExportWishes& wishes);

/// Writes each file. A pose there must be.
void write_exports(const Estimated& estimated, const ExportWishes& wishes);

/// The poses of the steps as they were known then; the path as it is known at the end, where the estimator looks back.
Estimated estimated_of(const Run& run, const ReplayResult& result);

/// The poses as they are known at the end. Health is of the poses that were known on the way, and left out.
Estimated refined_of(const Run& run, const ReplayResult& result);

}  // namespace azimuth
