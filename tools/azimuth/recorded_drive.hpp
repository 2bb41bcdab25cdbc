#pragma once
// Reads a run as a drive to be fitted, for the subcommands that judge its rig.

#include <cstdint>
#include <optional>
#include <string>

#include "tools/azimuth/replay_run.hpp"
#include "tools/drive_fit/drive.hpp"
#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

struct RecordedDrive {
  ReplaySetup setup;
  Drive drive;
};

/// Adds RUN and the options of add_run_options().
void add_drive_options(CLI::App& command, ReplayOptions& options);

/// Source of the data association for landmarks that have looks, but no names.
enum class NamedBy : std::uint8_t {
  filter,  ///< the filter of a replay, which recognises landmarks if the rig is about right
  eye,     ///< tracks from image to image, without the rig: see name_by_eye()
};

/// Reads the drive, from images if it has no bearings. Refuses a useless run with the likely cause, but accepts a run
/// that merely cannot tell enough. For `rig` see replay_setup().
RecordedDrive recorded_drive(const ReplayOptions& options, NamedBy named_by, const std::optional<Rig>& rig = {});

/// Refuses a drive if so few of its bearings fit that the numbers of the fit mean nothing.
void refuse_if_unfit(const DriveSolution& solution, const std::string& run);

/// The output files of a calibration. An empty path is not written.
struct CalibrationOutputs {
  std::filesystem::path rig, picture;
  std::filesystem::path html = {};  ///< of calibrate RUN alone
  bool force = false;
};
void add_calibration_outputs(CLI::App& command, CalibrationOutputs& outputs);
/// Refuses or fails before any work if an output cannot be written.
void check_outputs(const CalibrationOutputs& outputs);
/// Reads the text as a rig first, and then writes it.
void write_rig_text(const std::string& text, const std::filesystem::path& file);
/// Writes the rig below `comment`, whose lines begin with #.
void write_rig(const Rig& rig, const std::string& comment, const std::filesystem::path& file);

}  // namespace azimuth
