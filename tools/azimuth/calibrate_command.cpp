// azimuth calibrate: what images say about the camera, and drives about odometry and camera. One file for each thing
// that can be calibrated.

#include "tools/azimuth/command.hpp"

namespace azimuth {

void add_calibrate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "Find out from images and drives what rig.toml must say");
  command->require_subcommand(1);
  add_calibrate_mirror_command(*command);
  add_calibrate_fisheye_command(*command);
  add_calibrate_colour_command(*command);
  add_calibrate_odometry_command(*command);
  add_calibrate_heading_command(*command);
}

}  // namespace azimuth
