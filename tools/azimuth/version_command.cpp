// azimuth version

#include <cstdio>

#include "tools/azimuth/command.hpp"

namespace azimuth {

void add_version_command(CLI::App& app) {
  app.add_subcommand("version", "Print the version")->callback([] { std::puts("azimuth " AZIMUTH_VERSION); });
  app.set_version_flag("--version", "azimuth " AZIMUTH_VERSION);
}

}  // namespace azimuth
