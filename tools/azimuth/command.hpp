#pragma once
// Functions that the subcommands share: adding themselves, ending with errors, reading runs and maps.

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
inline constexpr Exit kInterrupted = 130;  ///< ended by Ctrl-C or SIGTERM; no output is half written
inline constexpr Exit kEndsLost = 3;       ///< a replay that wrote its outputs, but ends with a lost robot

/// A subcommand throws this to end the program. main() prints the message, one error per line.
struct CommandError {
  Exit code;
  std::string message;
};
void print_error(std::string message);  ///< prints to standard error, unless empty

std::string shown(const std::filesystem::path& file);  ///< the file's name, as visible() shows it

// `message` is one line; control characters of names in it are made visible.
[[noreturn]] void refuse(const std::string& message);  ///< ends with kBadInput
[[noreturn]] void refuse(const FileErrors& errors);
[[noreturn]] void fail(const std::string& message);  ///< ends with kFailure
[[noreturn]] void fail(const FileErrors& errors);
void fail_on(const FileResult<void>& result);  ///< fails if the result is an error

/// Reads the run in a folder or log. Refuses a run that cannot be read.
Run load_run_or_refuse(const std::filesystem::path& path, const LogOptions& options = {});

/// Reads the newest readable map of a file, see read_map(). Errors of newer maps are printed on standard error.
LoadedMap load_map_or_refuse(const std::filesystem::path& file);

inline constexpr const char* kRunHelp = "Run folder, LCM log or a daemon's session folder";

/// Adds --odometry-channel and --image-channel, for LCM logs of other programs.
void add_channel_options(CLI::App& command, LogOptions& options);
/// Adds --rig, --odometry-channel and --image-channel.
void add_log_options(CLI::App& command, LogOptions& options);

void write_text(const std::string& text, const std::filesystem::path& file);

// Each function adds a command, with its options and a callback that does the work, to `app` or to the parent command.
void add_replay_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_report_trajectory_command(CLI::App& report);
void add_report_compare_command(CLI::App& report);
void add_report_logs_command(CLI::App& report);
void add_map_command(CLI::App& app);
void add_map_merge_command(CLI::App& map);
void add_map_refine_command(CLI::App& map);
void add_simulate_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_import_command(CLI::App& app);
void add_doctor_command(CLI::App& app);
void add_calibrate_command(CLI::App& app);
void add_calibrate_colour_command(CLI::App& calibrate);
void add_calibrate_mirror_command(CLI::App& calibrate);
void add_calibrate_fisheye_command(CLI::App& calibrate);
void add_calibrate_odometry_command(CLI::App& calibrate);
void add_calibrate_heading_command(CLI::App& calibrate);
void add_check_command(CLI::App& app);
void add_view_command(CLI::App& app);

}  // namespace azimuth
