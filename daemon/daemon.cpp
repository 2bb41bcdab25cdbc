#include "daemon/daemon.hpp"

#include <chrono>
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
#include "daemon/devices/pioneer_source.hpp"
#include "daemon/devices/shared_camera_source.hpp"
#include "daemon/pipeline/pipeline.hpp"
#include "daemon/pipeline/played_source.hpp"
#include "daemon/supervise/logging.hpp"
#include "daemon/supervise/realtime.hpp"
#include "daemon/supervise/supervisor.hpp"
#include "drivers/io/run.hpp"
#include "drivers/io/session.hpp"
#include "settings/configuration.hpp"
#include "settings/file_text.hpp"
#include "settings/reference.hpp"
#include "settings/rig.hpp"
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

/// rig.toml as text, which is recorded, and as what it says.
struct RigFile {
  std::string file;
  std::string toml;
  Rig rig;
};

Outcome<RigFile> read_rig_text(std::string toml, const std::string& file) {
  Outcome<Rig> rig = read_rig(toml, file);
  if (!rig) return rig.violations();
  return RigFile{file, std::move(toml), *rig};
}

Outcome<RigFile> read_rig_named(const std::string& file) {
  Outcome<std::string> toml = file_text(file);
  return toml ? read_rig_text(std::move(toml).value(), file) : Outcome<RigFile>(toml.violations());
}

/// Where samples come from, and what belongs to them.
struct Origin {
  std::vector<std::unique_ptr<Source>> sources;
  std::optional<PerceptionStage> perception;
  RigFile rig;
  std::optional<Duration> epoch_minus_monotonic;  ///< none: the stamps are those of a recording
  std::string description;
};

/// What has to be added to CLOCK_MONOTONIC for microseconds since the Unix epoch. Asked once: from then on stamps run
/// evenly, whatever becomes of the wall clock.
Duration epoch_minus_monotonic() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  const auto since_boot = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<Duration>(since_epoch) - std::chrono::duration_cast<Duration>(since_boot);
}

Violations violations(const FileErrors& errors) {
  Violations violations;
  for (const FileError& error : errors) violations.push_back({error.file, error.line, 0, error.message});
  return violations;
}

Outcome<Origin> recorded_origin(const DaemonSettings& daemon) {
  FileResult<Run> run = load_run(daemon.play.run, {daemon.publish.channel_prefix});
  if (!run) return violations(run.errors());
  Outcome<RigFile> rig = daemon.rig.empty() ? read_rig_text(run->rig_toml, run->rig_file) : read_rig_named(daemon.rig);
  if (!rig) return rig.violations();
  Origin origin;
  origin.rig = std::move(rig).value();
  origin.description =
      fmt::format("playing {}: {} odometry readings, {} bearing sets, speed {}", daemon.play.run, run->odometry.size(),
                  run->bearings.size(), daemon.play.speed == 0.0 ? "max" : fmt::format("{}", daemon.play.speed));
  if (const std::string lost = run->skipped.text(); !lost.empty()) origin.description += "; " + lost;
  origin.sources.push_back(
      std::make_unique<PlayedSource>(Recording{std::move(run->odometry), std::move(run->bearings)}, daemon.play.speed));
  return origin;
}

Outcome<Origin> live_origin(const DaemonSettings& daemon) {
  const LiveSettings& live = daemon.live;
  Outcome<RigFile> rig = read_rig_named(daemon.rig);
  if (!rig) return rig.violations();
  Origin origin;
  origin.rig = std::move(rig).value();
  origin.epoch_minus_monotonic = epoch_minus_monotonic();
  origin.description = "odometer: Pioneer at " + live.pioneer.device;
  origin.sources.push_back(std::make_unique<PioneerSource>(live.pioneer, *origin.epoch_minus_monotonic));
  if (live.camera == CameraKind::shared) {
    origin.description += ", camera: " + live.camera_socket;
    const auto silent_after = std::chrono::duration_cast<SharedCameraSource::Clock::duration>(
        std::chrono::duration<double>(live.camera_silent_s));
    origin.sources.push_back(
        std::make_unique<SharedCameraSource>(live.camera_socket, *origin.epoch_minus_monotonic, silent_after));
  }
  return origin;
}

/// Gives `origin` what finds bearings in images, if its rig's front end works on images.
Outcome<Origin> with_perception(Outcome<Origin> outcome) {
  if (!outcome || outcome->rig.rig.front_end == FrontEnd::bearings) return outcome;
  Origin origin = std::move(outcome).value();
  const Rig& rig = origin.rig.rig;
  std::unique_ptr<Perception> perception = make_perception(rig.front_end, rig.camera, {});
  if (!perception) return Violations{{origin.rig.file, 0, 0, "the daemon has no such front end yet"}};
  origin.perception.emplace(std::move(perception), decoded_format(rig.front_end));
  return origin;
}

std::optional<Recorder> recorder(const Setup& setup, const RigFile& rig) {
  if (setup.daemon.record.folder.empty()) return std::nullopt;
  return std::optional<Recorder>(
      std::in_place, setup.daemon.record,
      std::vector<Document>{{"rig.toml", rig.toml},
                            {kConfigurationDocument, configuration_text(setup.configuration)},
                            {kVersionDocument, "azimuthd " AZIMUTH_VERSION "\n"}});
}

void run_pipeline(const Setup& setup, Origin origin, const Options& options, const EstimatorFactory& make_estimator) {
  const DaemonSettings& daemon = setup.daemon;
  const Rig& rig = origin.rig.rig;
  spdlog::info("{}", origin.description);
  if (daemon.lock_memory) {
    if (const std::string refusal = lock_memory(); !refusal.empty()) spdlog::warn("{}", refusal);
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file size is the recorder's trouble, not the end of the daemon
  const EkfSettings ekf = ekf_settings(setup.configuration, rig.camera.sigma_bearing_rad);
  Doorbell supervisor_bell;
  Pipeline pipeline({.sources = std::move(origin.sources),
                     .perception = std::move(origin.perception),
                     .estimator = EstimatorStage(make_estimator(rig, ekf), rig, setup.configuration.stage),
                     .publisher = Publisher(daemon.publish, origin.epoch_minus_monotonic),
                     .echo_samples = daemon.publish.echo_samples,
                     .recorder = recorder(setup, origin.rig)},
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
  Outcome<Origin> origin = with_perception(plays ? recorded_origin(daemon) : live_origin(daemon));
  if (!origin) return refuse(text(origin.violations()));
  if (options.check_config) return 0;
  set_up_logging(daemon.log_level);
  run_pipeline(*setup, std::move(origin).value(), options, make_estimator);
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
