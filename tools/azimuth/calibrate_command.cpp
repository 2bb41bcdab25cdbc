// azimuth calibrate: calibrates the camera from images, and odometry and camera from drives. Each subcommand has a file
// of its own, and so has the calibration of everything that a drive tells.

#include <memory>
#include <string>
#include <vector>

#include "tools/azimuth/calibrate_run.hpp"
#include "tools/azimuth/command.hpp"

namespace azimuth {

void add_calibrate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "Find the values of rig.toml from images and drives");
  command->require_subcommand(0, 1);
  const auto options = std::make_shared<RunCalibrationOptions>();
  command->add_option(
      "RUN", options->run.run,
      std::string(kRunHelp) + ", with a rig.toml or without: calibrate everything that the drive tells of the rig");
  add_run_options(*command, options->run);
  add_calibration_outputs(*command, options->outputs);
  command->get_option("--force")->description("Replace the files of --out and --html if they exist");
  command->add_option("--html", options->outputs.html,
                      "Write one self-contained page for a browser: what was found and replaced, what the drive cannot "
                      "tell, path and map, residuals of the bearings before and after, and the rig.toml of --out");
  command
      ->add_option("--only", options->only,
                   "Find these parts of the rig alone, and leave the rest as it is; may be repeated, or PART,PART")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{kRigParts.begin(), kRigParts.end()}));
  command->footer(
      "Without a rig.toml the calibration begins from images of a mirror or of lamps, or from bearings. Each "
      "subcommand finds out "
      "more\nabout one part of the rig.\nExit codes: 0 done, 1 a file could not be written, or there is no mirror, 2 "
      "wrong use or input, or the drive cannot tell.");
  command->callback([command, options] {
    if (!command->get_subcommands().empty()) {
      for (const char* const name : {"--only", "--html"})
        if (command->count(name) > 0) throw CLI::ExcludesError(name, command->get_subcommands().front()->get_name());
      return;
    }
    if (options->run.run.empty()) throw CLI::RequiredError("RUN or a subcommand");
    calibrate_by_run(*options);
  });
  add_calibrate_mirror_command(*command);
  add_calibrate_fisheye_command(*command);
  add_calibrate_colour_command(*command);
  add_calibrate_odometry_command(*command);
  add_calibrate_heading_command(*command);
}

}  // namespace azimuth
