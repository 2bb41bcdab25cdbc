#pragma once
// Export of estimates, shared by the subcommands.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/export/estimated.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// The export options of the command line.
struct ExportWishes {
  std::vector<std::string> files;  ///< FILE, or FORMAT:FILE
  std::string origin;              ///< place of the map's origin for GeoJSON; empty: unknown
};

/// Adds --export, which may be repeated, and --origin.
void add_export_options(CLI::App& command, ExportWishes& wishes);
/// Adds --origin alone.
void add_origin_option(CLI::App& command, ExportWishes& wishes);

/// Refuses unknown formats, and fails if a file could not be written.
void check_exports(const ExportWishes& wishes);

/// Prints a note on standard error if the coordinates have no place on the globe.
void tell_of_exports(const ExportWishes& wishes);

/// Writes each file. `estimated` must have a pose.
void write_exports(const Estimated& estimated, const ExportWishes& wishes);

/// The poses as they were known at each step, and the path as it is known at the end if the estimator is a smoother.
Estimated estimated_of(const Run& run, const ReplayResult& result);

/// The poses as they are known at the end. Health is left out, since it judges the poses known during the drive.
Estimated refined_of(const Run& run, const ReplayResult& result);

}  // namespace azimuth
