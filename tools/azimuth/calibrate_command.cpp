// azimuth calibrate: what images say about the camera. One file for each thing that can be calibrated.

#include "tools/azimuth/command.hpp"

namespace azimuth {

void add_calibrate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "Find out from images what rig.toml must say about the camera");
  command->require_subcommand(1);
  add_calibrate_mirror_command(*command);
  add_calibrate_colour_command(*command);
}

}  // namespace azimuth
