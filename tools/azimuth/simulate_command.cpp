// azimuth simulate: a run in a simulated world.

#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

#include "sim/world/scenario.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

struct SimulateOptions {
  std::filesystem::path out;
  std::string world = "lab";
  std::uint64_t seed = 1;
  int laps = 0;
  bool no_identities = false;
  double clutter_per_set = 0.0;
  bool force = false;
};

std::string known_worlds() {
  std::string names;
  for (const std::string_view name : kScenarioNames) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

void simulate_run(const SimulateOptions& options) {
  std::optional<Scenario> scenario = scenario_named(options.world, options.seed, options.laps);
  if (!scenario) refuse("--world " + options.world + ": not one of " + known_worlds());
  scenario->sensor.identities = !options.no_identities;
  scenario->sensor.clutter_per_set = options.clutter_per_set;
  check_output(options.out, options.force);
  const Run run = simulated_run(*scenario);
  write_run(run, options.out);
  fmt::print("{}: {} odometry readings, {} bearing sets, {} landmarks, {:.1f} s\n", options.out.string(),
             run.odometry.size(), run.bearings.size(), run.landmarks.size(),
             to_seconds(run.odometry.back().stamp - run.odometry.front().stamp));
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "Make a run in a simulated world; same seed, same bytes");
  const auto options = std::make_shared<SimulateOptions>();
  command->add_option("OUT", options->out, "LCM log if it ends in .lcmlog, .lcm or .log, else a run folder")
      ->required();
  command->add_option("--world", options->world, "One of " + known_worlds())->capture_default_str();
  command->add_option("--seed", options->seed, "Of landmarks and noise")->capture_default_str();
  command->add_option("--laps", options->laps, "Times round; 0: as the world has it")->check(CLI::Range(0, 1000));
  command->add_flag("--no-identities", options->no_identities, "Bearings do not say which landmark they are of");
  command->add_option("--clutter", options->clutter_per_set, "Mean number of false bearings a set")
      ->check(CLI::Range(0.0, 100.0));
  command->add_flag("--force", options->force, "Replace OUT");
  command->callback([options] { simulate_run(*options); });
}

}  // namespace azimuth
