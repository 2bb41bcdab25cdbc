// azimuth calibrate heading: finds the camera's mounting on the robot from a drive.

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>

#include "slam/geometry/angle.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/recorded_drive.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/drive_picture.hpp"

namespace azimuth {
namespace {

struct HeadingOptions {
  ReplayOptions run;
  CalibrationOutputs outputs;
};

std::string position_text(const HeadingCalibration& found) {
  if (!found.ahead.told)
    return "cannot tell to five centimetres, or from a lag: turn on the spot both ways, near landmarks";
  return fmt::format("camera.position_m = [{:.3f}, {:.3f}] +- {:.3f} m", found.ahead.value, found.left.value,
                     std::max(found.ahead.sigma, found.left.sigma));
}

/// Returns the rig `said` with the camera's mounting that was found, but with its own odometry.
Rig rig_with(const HeadingCalibration& found, const Rig& said) {
  RigGuess guess = found.solution.guess;
  guess.rig.odometry = said.odometry;
  guess.rig.camera.sigma_yaw_rad = found.yaw.sigma;
  return rig_saying(guess, said);
}

void calibrate(const HeadingOptions& options) {
  check_outputs(options.outputs);
  const RecordedDrive recorded = recorded_drive(options.run, NamedBy::eye);
  const Rig& said = recorded.setup.rig;
  const std::string run = options.run.run.string();
  if (const std::string why = why_cannot_tell(recorded.drive, said); !why.empty()) refuse(run + ": " + why);
  const HindsightSettings& settings = recorded.setup.configuration.smoother;
  const HeadingCalibration found = calibrate_heading(recorded.drive, said, settings);
  refuse_if_unfit(found.solution, run);
  if (!found.hand_told) refuse(run + ": cannot tell whether azimuths grow clockwise: drive longer, and turn");
  const double sigma_deg = rad_to_degrees(found.yaw.sigma);
  if (!found.yaw.told)
    refuse(
        fmt::format("{}: cannot tell the heading to half a degree: it is {:.1f} +- {:.1f} degrees off what the rig "
                    "says; drive longer, and straight on past landmarks",
                    run, rad_to_degrees(wrap(found.yaw.value - said.camera.yaw_offset_rad)), sigma_deg));
  const Rig rig = rig_with(found, said);
  if (!options.run.quiet) {
    fmt::print("drive       {} bearings used, {:.0f} % of them fit\n", found.solution.graph.bearings(),
               100.0 * found.solution.fitting);
    fmt::print("direction   {}{}\n", direction_text(rig),
               found.mirrored ? ", which the rig has the other way round" : "");
    fmt::print("offset      {} +- {:.2f} degrees\n", heading_text(rig), sigma_deg);
    fmt::print("position    {}\n", position_text(found));
  }
  if (!options.outputs.rig.empty())
    write_rig(rig, "# Made by azimuth calibrate heading from " + recorded.setup.run.name + ".\n", options.outputs.rig);
  if (options.outputs.picture.empty()) return;
  const MapPicture picture =
      drive_picture(recorded.drive, found.solution, said, settings, recorded.setup.run.name + ": heading calibrated",
                    fmt::format("{}, {} +- {:.2f} degrees", direction_text(rig), heading_text(rig), sigma_deg));
  if (const auto problem = write_map_picture(picture, options.outputs.picture))
    fail(options.outputs.picture.string() + ": " + *problem);
}

}  // namespace

void add_calibrate_heading_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("heading",
                                         "Find from a drive whether azimuths grow clockwise, where the camera's "
                                         "azimuth 0 points, and where the camera is on the robot");
  const auto options = std::make_shared<HeadingOptions>();
  add_drive_options(*command, options->run);
  add_calibration_outputs(*command, options->outputs);
  command->footer(
      "The command takes the odometry's turns to have the right sign: swapped wheels look like azimuths that grow "
      "clockwise.\nExit codes: 0 done, 1 a file could not be written, 2 wrong use or input, or the drive cannot tell.");
  command->callback([options] { calibrate(*options); });
}

}  // namespace azimuth
