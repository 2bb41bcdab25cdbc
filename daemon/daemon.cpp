#include "daemon/daemon.hpp"

#include <cstdio>
#include <spdlog/spdlog.h>
#include <utility>

#include "daemon/config/daemon_settings.hpp"
#include "daemon/config/options.hpp"
#include "daemon/pipeline/pipeline.hpp"
#include "daemon/pipeline/played_source.hpp"
#include "daemon/supervise/logging.hpp"
#include "daemon/supervise/realtime.hpp"
#include "daemon/supervise/supervisor.hpp"
#include "drivers/io/run.hpp"
#include "settings/configuration.hpp"
#include "settings/reference.hpp"
#include "settings/rig.hpp"

namespace azimuth {
namespace {

constexpr int kFailed = 1;
constexpr int kRefused = 2;

/// Everything the daemon was told, checked.
struct Setup {
  Configuration configuration;
  DaemonSettings daemon;
};

int refuse(const std::string& violations) {
  std::fputs(violations.c_str(), stderr);
  return kRefused;
}

void print_settings() {
  Configuration configuration;
  DaemonSettings daemon;
  std::vector<Section> sections = configuration_sections(configuration);
  for (Section& section : daemon_sections(daemon)) sections.push_back(std::move(section));
  std::fputs(
      "# Configuration of azimuthd and azimuth. Every key stands here as a comment with its default; remove the #\n"
      "# before a key to change it. `azimuthd --check-config` names everything that is wrong.\n\n",
      stdout);
  std::fputs(reference(pointers(sections)).c_str(), stdout);
}

Outcome<Setup> read_setup(const Options& options) {
  Setup setup;
  std::vector<Section> sections = daemon_sections(setup.daemon);
  Outcome<Configuration> configuration =
      read_configuration_file(options.config_file, options.overrides, pointers(sections));
  if (!configuration) return configuration.violations();
  if (Violations violations = check(setup.daemon); !violations.empty()) return violations;
  setup.configuration = *configuration;
  return setup;
}

Outcome<Rig> read_rig_of(const Run& run, const PlaySettings& play) {
  if (!play.rig.empty()) return read_rig_file(play.rig);
  return read_rig(run.rig_toml, run.rig_file);
}

Recording recording_of(Run& run) { return {std::move(run.odometry), std::move(run.bearings)}; }

int play(const Setup& setup, Run run, const Rig& rig, const Options& options, const EstimatorFactory& make_estimator) {
  const DaemonSettings& daemon = setup.daemon;
  const EkfSettings ekf = ekf_settings(setup.configuration, rig.camera.sigma_bearing_rad);
  if (const std::string lost = run.skipped.text(); !lost.empty()) spdlog::warn("{}: {}", daemon.play.run, lost);
  spdlog::info("playing {}: {} odometry readings, {} bearing sets, speed {}", daemon.play.run, run.odometry.size(),
               run.bearings.size(), daemon.play.speed == 0.0 ? "max" : fmt::format("{}", daemon.play.speed));
  if (daemon.lock_memory) {
    if (const std::string refusal = lock_memory(); !refusal.empty()) spdlog::warn("{}", refusal);
  }
  Doorbell supervisor_bell;
  std::vector<std::unique_ptr<Source>> sources;
  sources.push_back(std::make_unique<PlayedSource>(recording_of(run), daemon.play.speed));
  Pipeline pipeline({std::move(sources), EstimatorStage(make_estimator(rig, ekf), rig, setup.configuration.stage),
                     Publisher(daemon.publish), daemon.publish.echo_samples},
                    daemon.threads, supervisor_bell);
  Supervisor(pipeline, supervisor_bell, {daemon.play.hold, options.show_status}).run();
  return 0;
}

int run_with(const Options& options, const EstimatorFactory& make_estimator) {
  const Outcome<Setup> setup = read_setup(options);
  if (!setup) return refuse(text(setup.violations()));
  const PlaySettings& source = setup->daemon.play;
  if (source.run.empty()) {
    return options.check_config
               ? 0
               : refuse("azimuthd: no source of samples: give a recording with --play RUN or daemon.play.run\n");
  }
  FileResult<Run> run = load_run(source.run, {setup->daemon.publish.channel_prefix});
  if (!run) return refuse(text(run.errors()));
  const Outcome<Rig> rig = read_rig_of(*run, source);
  if (!rig) return refuse(text(rig.violations()));
  if (options.check_config) return 0;
  set_up_logging(setup->daemon.log_level);
  return play(*setup, *std::move(run), *rig, options, make_estimator);
}

}  // namespace

int run_daemon(int argc, char** argv, const EstimatorFactory& make_estimator) {
  block_stop_signals();
  const ParsedOptions parsed = parse_options(argc, argv);
  if (parsed.exit_code) return *parsed.exit_code;
  if (parsed.options.print_settings) {
    print_settings();
    return 0;
  }
  try {
    return run_with(parsed.options, make_estimator);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "azimuthd: %s\n", error.what());
    return kFailed;
  }
}

}  // namespace azimuth
