#pragma once
// What the subcommands share: how each is added, and how it ends.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "base/file_result.hpp"
#include "drivers/storage/map_file.hpp"
#include "drivers/storage/run.hpp"
#include "settings/command_line/command_line.hpp"

namespace azimuth {

/// Exit codes, the same for every subcommand.
using Exit = int;
inline constexpr Exit kDone = 0;
inline constexpr Exit kFailure = 1;        ///< the system refused something: a file could not be written
inline constexpr Exit kBadInput = 2;       ///< the command line, a configuration or the data is wrong
inline constexpr Exit kInterrupted = 130;  ///< by Ctrl-C or SIGTERM, as a shell says it; nothing is half written
inline constexpr Exit kEndsLost = 3;       ///< a replay, all having been written: the robot does not know where it is

/// Thrown by a subcommand to end the program; main() prints the message, one error a line.
struct CommandError {
  Exit code;
  std::string message;
};
void print_error(std::string message);  ///< to standard error, in lines; nothing for an empty one

std::string shown(const std::filesystem::path& file);  ///< its name, as visible() shows it

// `message` is one line, whatever names are in it.
[[noreturn]] void refuse(const std::string& message);  ///< ends with kBadInput
[[noreturn]] void refuse(const FileErrors& errors);
[[noreturn]] void fail(const std::string& message);  ///< ends with kFailure
[[noreturn]] void fail(const FileErrors& errors);
void fail_on(const FileResult<void>& result);  ///< likewise, if it is one

/// The run in a folder or log; refuses what cannot be read.
Run load_run_or_refuse(const std::filesystem::path& path, const LogOptions& options = {});

/// The newest map of a file that can be read, see read_map(); what was wrong with a newer one is said on standard
/// error.
LoadedMap load_map_or_refuse(const std::filesystem::path& file);

inline constexpr const char* kRunHelp = "Run folder, LCM log or a daemon's session folder";

/// Adds what says how a run of others is to be read: --rig, --odometry-channel, --image-channel.
void add_log_options(CLI::App& command, LogOptions& options);

void write_text(const std::string& text, const std::filesystem::path& file);

// Each adds itself to `app` with its options, and its work as a callback.
void add_replay_command(CLI::App& app);
void add_refine_command(CLI::App& app);
void add_map_command(CLI::App& app);
void add_map_merge_command(CLI::App& map);  // to that of add_map_command()
void add_evaluate_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_simulate_command(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_import_command(CLI::App& app);
void add_log_command(CLI::App& app);
void add_doctor_command(CLI::App& app);
void add_settings_command(CLI::App& app);
void add_version_command(CLI::App& app);
void add_calibrate_command(CLI::App& app);
void add_calibrate_colour_command(CLI::App& app);    // to that of add_calibrate_command()
void add_calibrate_mirror_command(CLI::App& app);    // to that of add_calibrate_command()
void add_calibrate_fisheye_command(CLI::App& app);   // to that of add_calibrate_command()
void add_calibrate_odometry_command(CLI::App& app);  // to that of add_calibrate_command()
void add_calibrate_heading_command(CLI::App& app);   // to that of add_calibrate_command()
void add_check_command(CLI::App& app);
void add_view_command(CLI::App& app);

}  // namespace azimuth
