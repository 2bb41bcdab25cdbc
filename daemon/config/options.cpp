#include "daemon/config/options.hpp"

#include <CLI/CLI.hpp>

#include "settings/command_line/command_line.hpp"

namespace azimuth {
namespace {

/// Adds a shorthand, which is stored as an override, so that it is checked like any other override.
void add_shorthand(CLI::App& app, Options& options, const std::string& flag, const std::string& key,
                   const std::string& help) {
  app.add_option_function<std::string>(
         flag, [&options, key](const std::string& value) { options.overrides.push_back(key + "=" + value); },
         help + " (" + key + ")")
      ->take_last();
}

}  // namespace

ParsedOptions parse_options(int argc, char** argv) {
  ParsedOptions parsed;
  Options& options = parsed.options;
  CLI::App app("Bearing-only SLAM: position and map of a robot from directions and wheel odometry.", "azimuthd");
  app.set_version_flag("--version", "azimuthd " AZIMUTH_VERSION);
  app.add_option("--config", options.config_file, "Configuration file (TOML)");
  app.add_flag("--check-config", options.check_config, "Check configuration and recording, then exit: 0 or 2");
  app.add_flag("--print-settings", options.print_settings, "Print the settings with their defaults, then exit");
  app.add_flag("--print-rig-settings", options.print_rig_settings,
               "Print the settings of rig.toml with their defaults, then exit");
  app.add_option("--set", options.overrides, "Override a setting with section.key=value; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  add_shorthand(app, options, "--play", "daemon.play.run", "Play a run folder or an LCM log");
  add_shorthand(app, options, "--rig", "daemon.rig",
                "rig.toml of the robot; for a recording, it replaces the recording's own");
  add_shorthand(app, options, "--record", "daemon.record.folder", "Record into this folder");
  app.add_option_function<std::string>(
      "--speed",
      [&options](const std::string& speed) {
        options.overrides.push_back("daemon.play.speed=" + (speed == "max" ? std::string("0") : speed));
      },
      "Speed, as a multiple of the recording's own; 0 or max: as fast as possible (daemon.play.speed)");
  add_shorthand(app, options, "--lcm-url", "daemon.lcm.url", "LCM provider to publish on");
  app.add_flag_callback(
      "--hold", [&options] { options.overrides.emplace_back("daemon.play.hold=true"); },
      "Keep running after the end of the recording (daemon.play.hold)");
  app.add_flag("--print-poses", options.print_poses, "Print a line for the pose of every step");
  app.add_flag("--status", options.show_status, "Print a status line each second, also without a terminal");
  parsed.exit_code = parse_command_line(app, argc, argv);
  return parsed;
}

}  // namespace azimuth
