// azimuth replay: a run through the estimator, as fast as it goes, and how good the outcome is.

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "drivers/io/tum.hpp"
#include "settings/configuration.hpp"
#include "settings/rig.hpp"
#include "slam/estimator/make_estimator.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/evaluate/report_json.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/replay_picture.hpp"
#include "tools/replay/replay_record.hpp"
#include "tools/replay/summary.hpp"

namespace azimuth {
namespace {

struct ReplayOptions {
  std::filesystem::path run, config, report, plot, tum;
  std::vector<std::string> overrides;
  std::uint64_t seed = 1;
  bool quiet = false;
};

Rig rig_of(const Run& run) {
  Outcome<Rig> rig = read_rig(run.rig_toml, run.rig_file);
  if (!rig) refuse(rig.violations());
  if (rig->front_end != FrontEnd::bearings)
    refuse(run.rig_file + ": front_end \"" + front_end_name(rig->front_end) +
           "\" works on images; only runs with bearings can be replayed");
  return std::move(rig).value();
}

Configuration configuration_of(const ReplayOptions& options) {
  Outcome<Configuration> configuration = read_configuration_file(options.config, options.overrides);
  if (!configuration) refuse(configuration.violations());
  return std::move(configuration).value();
}

void write_tum_file(const ReplayResult& result, const std::filesystem::path& file) {
  std::vector<std::pair<Stamp, Pose2>> trajectory;
  for (const EstimateRecord& estimate : result.estimates) trajectory.emplace_back(estimate.stamp, estimate.T_map_body);
  fail_on(write_tum(trajectory, file));
}

void write_plot(const Run& run, const ReplayResult& result, const Report& report, const std::filesystem::path& file) {
  if (const auto problem = write_png(replay_picture(run, result, report), file.string()))
    fail(file.string() + ": " + *problem);
}

void replay_run(const ReplayOptions& options) {
  const Configuration configuration = configuration_of(options);
  const Run run = load_run_or_refuse(options.run);
  const Rig rig = rig_of(run);
  if (run.bearings.empty()) refuse(options.run.string() + ": has no bearings");

  const EkfSettings ekf = ekf_settings(configuration, rig.camera.sigma_bearing_rad);
  ProgressBar bar(!options.quiet);
  const ReplayResult result = replay(run, rig, make_ekf_estimator(rig, ekf), configuration.stage,
                                     [&bar](std::size_t done, std::size_t all) { bar.update(done, all); });
  bar.clear();

  const Report report = evaluate(replay_record(run, rig, configuration.estimator, options.seed, result));
  if (!options.report.empty()) write_text(to_json(report), options.report);
  if (!options.tum.empty()) write_tum_file(result, options.tum);
  if (!options.plot.empty()) write_plot(run, result, report, options.plot);
  if (!options.quiet) std::fputs(summary(run, result, report).c_str(), stdout);
}

}  // namespace

void add_replay_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("replay", "Run the estimator over a recorded run and report how good it is");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("RUN", options->run, "Run folder or LCM log")->required();
  command->add_option("--report", options->report, "Write the report as JSON");
  command->add_option("--config", options->config, "Configuration (TOML); without it every key has its default");
  command->add_option("--set", options->overrides, "Override one key, e.g. ekf.gate_chi2=9; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--seed", options->seed, "For estimators that draw random numbers")->capture_default_str();
  command->add_option("--plot", options->plot, "Draw the map as a PNG");
  command->add_option("--tum", options->tum, "Write the trajectory in TUM format");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options] { replay_run(*options); });
}

}  // namespace azimuth
