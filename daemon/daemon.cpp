#include "daemon/daemon.hpp"

#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <spdlog/spdlog.h>
#include <utility>
#include <vector>

#include "daemon/config/daemon_settings.hpp"
#include "daemon/config/options.hpp"
#include "daemon/origin.hpp"
#include "daemon/pipeline/pipeline.hpp"
#include "daemon/saved_map.hpp"
#include "daemon/supervise/logging.hpp"
#include "daemon/supervise/realtime.hpp"
#include "daemon/supervise/supervisor.hpp"
#include "drivers/io/session.hpp"
#include "settings/configuration.hpp"
#include "settings/reference.hpp"
#include "slam/perception/make_perception.hpp"

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

/// What finds the bearings, if that is to be done here.
Outcome<std::optional<PerceptionStage>> perception(const Configuration& configuration, const Origin& origin) {
  if (!origin.needs_perception) return std::optional<PerceptionStage>();
  const Rig& rig = origin.rig.rig;
  const auto refuse_rig = [&](const char* why) { return Violations{{origin.rig.file, 0, 0, why}}; };
  if (rig.camera.model == "bearings") return refuse_rig("camera model \"bearings\" takes no images");
  std::unique_ptr<Perception> front_end = make_perception(rig.front_end, rig.camera, configuration.perception);
  if (!front_end) return refuse_rig("its front end does not exist yet");
  return std::optional<PerceptionStage>(std::in_place, std::move(front_end), decoded_format(rig.front_end));
}

/// With all that a replay needs to start as the estimator does.
std::optional<Recorder> recorder(const Setup& setup, const RigFile& rig, const std::optional<LoadedMap>& map) {
  if (setup.daemon.record.folder.empty()) return std::nullopt;
  std::vector<Document> documents{{"rig.toml", rig.toml},
                                  {kConfigurationDocument, configuration_text(setup.configuration)},
                                  {kVersionDocument, "azimuthd " AZIMUTH_VERSION "\n"}};
  if (map) {
    const std::string bytes(reinterpret_cast<const char*>(map->bytes.data()), map->bytes.size());
    documents.push_back({kMapDocument, bytes, true});
  }
  return std::optional<Recorder>(std::in_place, setup.daemon.record, std::move(documents));
}

std::optional<MapKeeper> keeper(const Setup& setup, const MapKeeperStatus& status) {
  if (setup.daemon.map.file.empty()) return std::nullopt;
  const bool saves = setup.configuration.map.mode != MapMode::localise;
  return std::optional<MapKeeper>(std::in_place, setup.daemon.map, status, saves);
}

std::optional<Painter> painter(const DaemonSettings& daemon, const Rig& rig) {
  if (daemon.picture.rate_hz <= 0.0) return std::nullopt;
  return std::optional<Painter>(std::in_place, daemon.picture, daemon.publish, rig.camera);
}

void run_pipeline(const Setup& setup, Origin origin, std::optional<PerceptionStage> perceives, const SavedMap& saved,
                  const Options& options, const EstimatorFactory& make_estimator) {
  const DaemonSettings& daemon = setup.daemon;
  const Rig& rig = origin.rig.rig;
  spdlog::info("{}", origin.description);
  if (!saved.status.text.empty())
    spdlog::log(saved.status.trouble ? spdlog::level::warn : spdlog::level::info, "map: {}", saved.status.text);
  const MapSnapshot* const map = saved.loaded ? &saved.loaded->map : nullptr;
  if (daemon.lock_memory) {
    if (const std::string refusal = lock_memory(); !refusal.empty()) spdlog::warn("{}", refusal);
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file size is the recorder's trouble, not the end of the daemon
  Doorbell supervisor_bell;
  Pipeline pipeline(
      {.sources = std::move(origin.sources),
       .perception = std::move(perceives),
       .estimator = EstimatorStage(make_estimator(rig, setup.configuration, map), rig, setup.configuration.stage),
       .publisher = Publisher(daemon.publish, origin.epoch_minus_monotonic),
       .echo_samples = daemon.publish.echo_samples,
       .painter = painter(daemon, rig),
       .recorder = recorder(setup, origin.rig, saved.loaded),
       .keeper = keeper(setup, saved.status)},
      daemon.threads, supervisor_bell);
  Supervisor(pipeline, supervisor_bell, {daemon.play.hold, options.show_status}).run();
}

int run_with(const Options& options, const EstimatorFactory& make_estimator) {
  const Outcome<Setup> setup = read_setup(options);
  if (!setup) return refuse(text(setup.violations()));
  const DaemonSettings& daemon = setup->daemon;
  const bool plays = !daemon.play.run.empty();
  if (!plays && daemon.live.odometer == OdometerKind::none) {
    return options.check_config ? 0
                                : refuse(
                                      "azimuthd: no source of samples: give a recording with --play RUN "
                                      "(daemon.play.run), or an odometer (daemon.live.odometer)\n");
  }
  Outcome<Origin> origin = plays ? recorded_origin(daemon) : live_origin(daemon);
  if (!origin) return refuse(text(origin.violations()));
  Outcome<std::optional<PerceptionStage>> perceives = perception(setup->configuration, *origin);
  if (!perceives) return refuse(text(perceives.violations()));
  Outcome<SavedMap> saved = saved_map(daemon.map, setup->configuration, origin->rig.rig);
  if (!saved) return refuse(text(saved.violations()));
  if (options.check_config) return 0;
  set_up_logging(daemon.log_level);
  run_pipeline(*setup, std::move(origin).value(), std::move(perceives).value(), *saved, options, make_estimator);
  return 0;
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
