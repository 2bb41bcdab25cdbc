// azimuth settings: the keys but the daemon's own, with unit, range and default.

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "settings/configuration.hpp"
#include "settings/reference.hpp"
#include "settings/rig.hpp"
#include "tools/azimuth/command.hpp"

namespace azimuth {
namespace {

void print_reference(std::vector<Section> sections, Tier down_to) {
  const std::vector<Section*> all = pointers(sections);
  std::fputs(reference(all, down_to).c_str(), stdout);
}

void print_settings(bool of_rig, bool all) {
  RigKeys rig;
  Configuration configuration;
  if (of_rig) return print_reference(rig_sections(rig), Tier::expert);
  std::fputs(
      "# Keys of the configuration that azimuth and azimuthd share. Those of the daemon alone, in the tables "
      "[daemon]\n"
      "# and below, azimuthd --print-settings has with these; those of rig.toml: azimuth settings --rig.\n",
      stdout);
  if (!all) std::fputs("# Those that are right as they are for nearly everybody: azimuth settings --all.\n", stdout);
  std::fputs("\n", stdout);
  print_reference(configuration_sections(configuration), all ? Tier::expert : Tier::everyday);
}

}  // namespace

void add_settings_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "settings", "Print the keys of the configuration that are not the daemon's alone, with range and default");
  const auto of_rig = std::make_shared<bool>(false), all = std::make_shared<bool>(false);
  command->add_flag("--rig", *of_rig, "The keys of rig.toml instead");
  command->add_flag("--all", *all, "Those for experts as well");
  command->callback([of_rig, all] { print_settings(*of_rig, *all); });
}

}  // namespace azimuth
