// azimuth settings: every key, its unit, range and default.

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
  print_reference(of_rig ? rig_sections(rig) : configuration_sections(configuration));
}

}  // namespace

void add_settings_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("settings", "Print every key of the configuration with its range and default");
  const auto of_rig = std::make_shared<bool>(false);
  command->add_flag("--rig", *of_rig, "The keys of rig.toml instead");
  command->callback([of_rig] { print_settings(*of_rig); });
}

}  // namespace azimuth
