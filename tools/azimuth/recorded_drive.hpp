#pragma once
// A run as a drive to be fitted, for the subcommands that judge its rig.

#include <string>

#include "tools/azimuth/replay_run.hpp"
#include "tools/drive_fit/drive.hpp"

namespace azimuth {

struct RecordedDrive {
  ReplaySetup setup;
  Drive drive;
};

/// Adds RUN and what else says what is read.
void add_drive_options(CLI::App& command, ReplayOptions& options);

/// Looks at images if need be, with names from the filter that a replay has for landmarks known by their looks. Refuses
/// what is of no use, with the likely cause; not what merely cannot tell.
RecordedDrive recorded_drive(const ReplayOptions& options);

/// Where things are written that a calibration found. Empty: not asked for.
struct CalibrationOutputs {
  std::filesystem::path rig, picture;
  bool force = false;
};
void add_calibration_outputs(CLI::App& command, CalibrationOutputs& outputs);
/// Refuses and fails before any work.
void check_outputs(const CalibrationOutputs& outputs);
/// With `comment` above, lines that begin with #; checked by reading it back.
void write_rig(const Rig& rig, const std::string& comment, const std::filesystem::path& file);

}  // namespace azimuth
