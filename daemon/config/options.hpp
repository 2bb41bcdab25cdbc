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
  bool all_settings = false;  ///< to be printed
  bool show_status = false;
  std::vector<std::string> overrides;  ///< `section.key=value`, shorthands such as --play included
};

/// Either options, or what to print and the exit code to end with (help, version, a wrong option).
struct ParsedOptions {
  Options options;
  std::optional<int> exit_code;
};

/// Prints help, version and errors itself.
ParsedOptions parse_options(int argc, char** argv);

}  // namespace azimuth
