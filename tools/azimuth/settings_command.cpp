// azimuth settings: every key but the daemon's own, its unit, range and default.

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

void print_reference(std::vector<Section> sections) {
  const std::vector<Section*> all = pointers(sections);
  std::fputs(reference(all).c_str(), stdout);
}

void print_settings(bool of_rig) {
  Rig rig;
  Configuration configuration;
  if (!of_rig)
    std::fputs(
        "# Keys of the configuration that azimuth and azimuthd share. Those of the daemon alone, in the tables "
        "[daemon]\n"
        "# and below, azimuthd --print-settings has with these; those of rig.toml: azimuth settings --rig.\n\n",
        stdout);
  print_reference(of_rig ? rig_sections(rig) : configuration_sections(configuration));
}

}  // namespace

void add_settings_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "settings", "Print every key of the configuration that is not the daemon's alone, with its range and default");
  const auto of_rig = std::make_shared<bool>(false);
  command->add_flag("--rig", *of_rig, "The keys of rig.toml instead");
  command->callback([of_rig] { print_settings(*of_rig); });
}

}  // namespace azimuth
