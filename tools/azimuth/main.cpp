#include <CLI/CLI.hpp>
#include <exception>
#include <fmt/format.h>
#include <initializer_list>
#include <string_view>

#include "base/visible.hpp"
#include "settings/command_line/command_line.hpp"
#include "tools/azimuth/command.hpp"

namespace {

/// A command of version 0.1.0, and the command that replaces it.
struct OldCommand {
  std::string_view name, now;
};

constexpr OldCommand kOldCommands[] = {
    {"compare", "azimuth report compare"},
    {"convert", "azimuth import LOG RUN, or azimuth export RUN FILE.lcmlog"},
    {"evaluate", "azimuth report trajectory"},
    {"log", "azimuth report logs"},
    {"refine", "azimuth map refine"},
    {"settings", "azimuthd --print-settings, or azimuthd --print-rig-settings"},
    {"version", "azimuth --version"},
};

/// Refuses a command of an earlier version with the name of the new one.
void refuse_old_command(int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  for (const OldCommand& old : kOldCommands)
    if (old.name == word) azimuth::refuse(fmt::format("azimuth {} is now: {}", old.name, old.now));
}

int run(int argc, char** argv) {
  refuse_old_command(argc, argv);
  CLI::App app{"Azimuth: calibrate a robot's rig, import its drives, replay and judge them, keep its maps.", "azimuth"};
  app.set_version_flag("--version", "azimuth " AZIMUTH_VERSION);
  app.require_subcommand(1);
  using Add = void (*)(CLI::App&);
  const auto add_group = [&app](const char* name, std::initializer_list<Add> commands) {
    for (const Add add : commands) add(app);
    for (CLI::App* command :
         app.get_subcommands([](const CLI::App* each) { return each->get_group() == "Subcommands"; }))
      command->group(name);
  };
  add_group("Start", {azimuth::add_doctor_command, azimuth::add_import_command, azimuth::add_calibrate_command,
                      azimuth::add_check_command, azimuth::add_view_command});
  add_group("Try and tune", {azimuth::add_replay_command, azimuth::add_simulate_command, azimuth::add_report_command});
  add_group("Maps and other programs", {azimuth::add_map_command, azimuth::add_export_command});
  return azimuth::parse_command_line(app, argc, argv).value_or(azimuth::kDone);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const azimuth::CommandError& error) {
    azimuth::print_error(error.message);
    return error.code;
  } catch (const std::exception& error) {
    azimuth::print_error("azimuth: " + azimuth::visible(error.what()));
    return azimuth::kFailure;
  }
}
