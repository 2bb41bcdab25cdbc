// azimuth simulate: makes a run in a simulated world.

#include <fmt/format.h>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "sim/renderer/standard_cameras.hpp"
#include "sim/world/scenario.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/azimuth/progress_bar.hpp"
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
  double most_s = std::numeric_limits<double>::infinity();
  RenderSettings images{.camera = ""};
  bool force = false;
};

std::string known_worlds() {
  std::string names;
  for (const std::string_view name : kScenarioNames) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

/// Simulates the run with bearings, or with the images of a camera instead.
Run run_through(const Scenario& scenario, const SimulateOptions& options) {
  if (options.images.camera.empty()) return first_seconds(simulated_run(scenario), options.most_s);
  if (is_log_name(options.out))
    refuse(options.out.string() + ": images are written into a run folder; azimuth export makes a log of it");
  ProgressBar bar(true, "images");
  FileResult<Run> run = rendered_run(scenario, options.images, options.out, options.most_s, bar.listener());
  if (!run) refuse(run.error());
  return *std::move(run);
}

void simulate_run(const SimulateOptions& options) {
  std::optional<Scenario> scenario = scenario_named(options.world, options.seed, options.laps);
  if (!scenario) refuse("--world " + options.world + ": not one of " + known_worlds());
  scenario->sensor.identities = !options.no_identities;
  scenario->sensor.clutter_per_set = options.clutter_per_set;
  check_output(options.out, options.force);
  const Run run = run_through(*scenario, options);
  write_run(run, options.out);
  const bool has_images = !run.frames.empty();
  fmt::print("{}: {} odometry readings, {} {}, {} landmarks, {:.1f} s\n", shown(options.out), run.odometry.size(),
             has_images ? run.frames.size() : run.bearings.size(), has_images ? "images" : "bearing sets",
             run.landmarks.size(), to_seconds(run.odometry.back().stamp - run.odometry.front().stamp));
}

void add_image_options(CLI::App& command, RenderSettings& images) {
  CLI::Option* const camera =
      command.add_option("--camera", images.camera, "Camera whose images the run has in place of bearings")
          ->check(CLI::IsMember(std::vector<std::string>{kStandardCameras.begin(), kStandardCameras.end()}));
  command.add_option("--size", images.size, "Size of the images, as a multiple of 1024x768")
      ->check(CLI::Range(0.1, 2.0))
      ->needs(camera)
      ->capture_default_str();
  for (const auto& [name, angle_rad, what] :
       {std::tuple{"--roll-rad", &images.roll_rad, "Roll of the camera, its left side lifted; the run's rig says so"},
        std::tuple{"--pitch-rad", &images.pitch_rad,
                   "Pitch of the camera, its front side lowered; the run's rig says so"}})
    command.add_option(name, *angle_rad, what)->check(CLI::Range(-0.5, 0.5))->needs(camera)->capture_default_str();
  command.add_option("--quality", images.quality, "JPEG quality of the images")
      ->check(CLI::Range(1, 100))
      ->needs(camera)
      ->capture_default_str();
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("simulate", "Make a run in a simulated world; the same seed gives the same bytes");
  const auto options = std::make_shared<SimulateOptions>();
  command
      ->add_option("OUT", options->out,
                   "Run to write: an LCM log if the name ends in .lcmlog, .lcm or .log, else a run folder")
      ->required();
  command->add_option("--world", options->world, "World to simulate")
      ->type_name(choices_text({kScenarioNames.begin(), kScenarioNames.end()}))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of landmarks and noise")->capture_default_str();
  command->add_option("--laps", options->laps, "Number of laps; 0: as many as the world says")
      ->check(CLI::Range(0, 1000));
  command->add_flag("--no-identities", options->no_identities,
                    "Make bearings without the identities of their landmarks");
  command->add_option("--clutter", options->clutter_per_set, "Mean number of false bearings per set")
      ->check(CLI::Range(0.0, 100.0));
  command->add_option("--seconds", options->most_s, "Stop after this time, in seconds")->check(CLI::Range(1.0, 1e6));
  add_image_options(*command, options->images);
  command->add_flag("--force", options->force, "Replace OUT if it exists");
  command->callback([options] { simulate_run(*options); });
}

}  // namespace azimuth
