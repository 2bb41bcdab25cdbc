#pragma once
// A run as a drive to be fitted, for the subcommands that judge its rig.

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

/// Adds RUN and what else says what is read.
void add_drive_options(CLI::App& command, ReplayOptions& options);

/// Who says which is which of landmarks that have looks, but no names.
enum class NamedBy : std::uint8_t {
  filter,  ///< that of a replay: it knows what it sees again, if the rig is about right
  eye,     ///< nobody who goes by the rig: see name_by_eye()
};

/// Looks at images if need be. Refuses what is of no use, with the likely cause; not what merely cannot tell. With a
/// `rig`: see replay_setup().
RecordedDrive recorded_drive(const ReplayOptions& options, NamedBy named_by, const std::optional<Rig>& rig = {});

/// Too few of its bearings fit for any number of the fit to mean anything.
void refuse_if_unfit(const DriveSolution& solution, const std::string& run);

/// Where things are written that a calibration found. Empty: not asked for.
struct CalibrationOutputs {
  std::filesystem::path rig, picture;
  bool force = false;
};
void add_calibration_outputs(CLI::App& command, CalibrationOutputs& outputs);
/// Refuses and fails before any work.
void check_outputs(const CalibrationOutputs& outputs);
/// Checked by reading it back first.
void write_rig_text(const std::string& text, const std::filesystem::path& file);
/// With `comment` above, lines that begin with #.
void write_rig(const Rig& rig, const std::string& comment, const std::filesystem::path& file);

}  // namespace azimuth
