#pragma once
#include <optional>
#include <string>
#include <vector>

namespace azimuth {

/// The command line of azimuthd.
struct Options {
  std::string config_file;  ///< empty: all defaults
  bool check_config = false;
  bool print_settings = false;
  bool print_rig_settings = false;
  bool print_poses = false;  ///< print a line for the pose of every step
  bool show_status = false;
  std::vector<std::string> overrides;  ///< `section.key=value`, including those from shorthands such as --play
};

/// Either the options, or the exit code with which the process is to end (after help, version or a wrong option).
struct ParsedOptions {
  Options options;
  std::optional<int> exit_code;
};

/// Parses the command line. Prints help, version and errors itself.
ParsedOptions parse_options(int argc, char** argv);

}  // namespace azimuth
