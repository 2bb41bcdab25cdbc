#include "daemon/daemon.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <spdlog/spdlog.h>
#include <utility>
#include <vector>

#include "base/visible.hpp"
#include "daemon/config/daemon_settings.hpp"
#include "daemon/config/options.hpp"
#include "daemon/daemon_setup.hpp"
#include "daemon/journal/journal.hpp"
#include "daemon/pipeline/pipeline.hpp"
#include "daemon/supervise/logging.hpp"
#include "daemon/supervise/realtime.hpp"
#include "daemon/supervise/service_manager.hpp"
#include "daemon/supervise/supervisor.hpp"
#include "drivers/storage/session.hpp"
#include "settings/rig.hpp"
#include "settings/sample_sentence.hpp"
#include "settings/section.hpp"

namespace azimuth {
namespace {

constexpr int kFailed = 1;
constexpr int kRefused = 2;

int refuse(const std::string& violations) {
  std::fputs(visible_lines(violations).c_str(), stderr);
  return kRefused;
}

void print_settings() {
  Configuration configuration;
  DaemonSettings daemon;
  std::vector<Section> sections = configuration_sections(configuration);
  for (Section& section : daemon_sections(daemon)) sections.push_back(std::move(section));
  std::fputs(
      "# Configuration of azimuthd and azimuth. Each key stands here as a comment with its default; remove the # "
      "before "
      "a\n"
      "# key to change it. `azimuthd --check-config` names everything that is wrong. Relative paths begin at this "
      "file's\n"
      "# folder. Only azimuthd reads the tables [daemon] and below. The keys of rig.toml: `azimuthd "
      "--print-rig-settings`.\n\n",
      stdout);
  std::fputs(reference(pointers(sections)).c_str(), stdout);
}

void print_rig_settings() {
  RigKeys rig;
  std::vector<Section> sections = rig_sections(rig);
  std::fputs(reference(pointers(sections)).c_str(), stdout);
}

/// The documents that a replay needs for an estimator with the same start.
std::vector<Document> documents(const DaemonSetup& setup) {
  const std::optional<LoadedMap>& map = setup.saved.loaded;
  std::vector<Document> documents{{"rig.toml", setup.origin.rig.toml},
                                  {kConfigurationDocument, configuration_text(setup.configuration)},
                                  {kVersionDocument, "azimuthd " AZIMUTH_VERSION "\n"}};
  if (map) {
    const std::string bytes(reinterpret_cast<const char*>(map->bytes.data()), map->bytes.size());
    documents.push_back({kMapDocument, bytes, true});
  }
  if (setup.odometry.kept) {
    std::vector<std::byte> bytes;
    encode(*setup.odometry.kept, bytes);
    documents.push_back({kOdometryDocument, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, true});
  }
  return documents;
}

EventTimes event_times(const Origin& origin) {
  return origin.epoch_minus_monotonic ? EventTimes::live(*origin.epoch_minus_monotonic)
                                      : EventTimes::of_recording(origin.first_stamp);
}

Publisher publisher(const DaemonSetup& setup) {
  Publisher publisher(setup.daemon.publish, setup.origin.epoch_minus_monotonic);
  publisher.documents(documents(setup));
  return publisher;
}

std::optional<Recorder> recorder(const DaemonSetup& setup, const EventTimes& times) {
  if (setup.daemon.record.folder.empty()) return std::nullopt;
  return std::optional<Recorder>(std::in_place, setup.daemon.record, documents(setup), times);
}

/// Only images that perception processes can be recorded.
bool records_images(const DaemonSetup& setup) {
  return setup.daemon.record.frames != RecordedFrames::none && setup.perception.has_value();
}

std::optional<FrameRecorder> frame_recorder(const DaemonSetup& setup, const EventTimes& times) {
  if (setup.daemon.record.folder.empty() || !records_images(setup)) return std::nullopt;
  return std::optional<FrameRecorder>(std::in_place, setup.daemon.record, times);
}

std::optional<MapKeeper> keeper(const DaemonSetup& setup) {
  if (setup.daemon.map.file.empty()) return std::nullopt;
  const bool saves = setup.configuration.map.mode != MapMode::localise;
  std::optional<OdometryKeeper> odometry;
  if (const auto epoch = setup.origin.epoch_minus_monotonic) {
    odometry.emplace(setup.daemon.map.file, stamp_clock(*epoch));
    if (const auto& map = setup.saved.loaded) odometry->map_is(map->map.stamp, map_checksum(map->bytes));
  }
  return std::optional<MapKeeper>(std::in_place, setup.daemon.map, setup.saved.status, saves, std::move(odometry));
}

std::optional<Painter> painter(const DaemonSettings& daemon, const Rig& rig) {
  if (daemon.picture.rate_hz <= 0.0) return std::nullopt;
  return std::optional<Painter>(std::in_place, daemon.picture, daemon.publish, rig.camera);
}

/// Returns why no pictures can be made although they are configured; empty: there is no such trouble.
std::string picture_trouble(const DaemonSetup& setup) {
  if (setup.daemon.picture.rate_hz <= 0.0 || setup.perception) return {};
  return fmt::format(
      "daemon.picture.rate_hz is {:g}, but bearings come ready made (front_end in {}), so there is no image to draw in",
      setup.daemon.picture.rate_hz, setup.origin.rig.file);
}

void report(const DaemonSetup& setup) {
  for (const std::string& warning : setup.configuration.warnings) spdlog::warn("{}", warning);
  spdlog::info("{}", setup.origin.description);
  if (const std::string trouble = picture_trouble(setup); !trouble.empty()) spdlog::warn("picture: {}", trouble);
  if (setup.daemon.record.frames != RecordedFrames::none && !records_images(setup))
    spdlog::warn(
        "daemon.record.frames: no images are recorded, since none are looked at: the bearings come ready made");
  if (records_images(setup) && setup.daemon.record.folder.empty())
    spdlog::warn("daemon.record.frames: no images are recorded, since daemon.record.folder is empty");
  const MapKeeperStatus& map = setup.saved.status;
  if (map.trouble)
    log_event(JournalEvent::map_trouble, "map: " + map.text);
  else if (setup.saved.loaded)
    log_event(JournalEvent::map_loaded, "map: " + map.text);
  else if (!map.text.empty())
    spdlog::info("map: {}", map.text);
  if (!setup.odometry.text.empty()) spdlog::info("{}", setup.odometry.text);
}

/// Reads the configuration again, into `next` if nothing is wrong with it. Otherwise logs each error and returns a
/// short text; empty: success.
std::string reload(const Options& options, std::optional<DaemonSetup>& next) {
  try {
    FileResult<DaemonSetup> read = read_setup_anew(options);
    if (read) {
      next = std::move(read).value();
      return {};
    }
    for (const FileError& violation : read.error()) log_event(JournalEvent::configuration_refused, violation.text());
    const std::size_t others = read.error().size() - 1;
    return read.error()[0].text() + (others > 0 ? fmt::format(" (and {} more)", others) : std::string());
  } catch (const std::exception& error) {
    log_event(JournalEvent::configuration_refused, error.what());
    return error.what();
  }
}

Bequest bequest_of(const Pipeline& pipeline, const PipelineEnd& end) {
  Bequest bequest{.map = {}, .pose_known = end.pose_known, .lost = end.lost};
  MapSnapshot map;
  if (pipeline.last_map(map)) bequest.map = std::move(map);
  return bequest;
}

EstimatorStage estimator_stage(const DaemonSetup& setup, const EstimatorFactory& make_estimator) {
  const Rig& rig = setup.origin.rig.rig;
  const MapSnapshot* const map = setup.saved.loaded ? &setup.saved.loaded->map : nullptr;
  std::optional<OdometrySince> since;
  if (setup.odometry.kept) since = setup.odometry.kept->since;
  return {make_estimator(rig, setup.configuration, map), rig, setup.configuration.stage, since};
}

/// How a pipeline ended.
struct PipelineOutcome {
  std::optional<DaemonSetup> next;  ///< the setup of the next pipeline; none: the daemon ends
  int exit_code = 0;                ///< used when `next` is empty
};

/// A played recording that gave no step must end with an error.
int exit_code_of(const PipelineEnd& end) {
  if (!end.played_out || end.steps > 0) return 0;
  const std::string why = sentence(end.samples);
  spdlog::error("no step was made{}{}", why.empty() ? "" : ": ", why);
  return kRefused;
}

/// Runs one pipeline until the daemon is to end, or to continue with another setup.
PipelineOutcome run_pipeline(DaemonSetup setup, const Options& options, ServiceManager& manager,
                             const EstimatorFactory& make_estimator, std::chrono::steady_clock::time_point started) {
  const DaemonSettings& daemon = setup.daemon;
  const Rig& rig = setup.origin.rig.rig;
  find_odometry(setup);
  report(setup);
  if (!daemon.lock_memory) unlock_memory();
  std::string no_picture = picture_trouble(setup);
  const EventTimes times = event_times(setup.origin);
  std::optional<Recorder> samples = recorder(setup, times);
  std::optional<FrameRecorder> images = frame_recorder(setup, times);
  std::optional<DaemonSetup> next;
  Doorbell supervisor_bell;
  Pipeline pipeline({.sources = std::move(setup.origin.sources),
                     .perception = std::move(setup.perception),
                     .estimator = estimator_stage(setup, make_estimator),
                     .publisher = publisher(setup),
                     .echo_samples = daemon.publish.echo_samples,
                     .painter = painter(daemon, rig),
                     .recorder = std::move(samples),
                     .frame_recorder = std::move(images),
                     .keeper = keeper(setup),
                     .picture_trouble = std::move(no_picture)},
                    daemon.threads, supervisor_bell);
  const PipelineEnd end = Supervisor(pipeline, supervisor_bell, manager,
                                     {.hold = daemon.play.hold,
                                      .show_status = options.show_status,
                                      .lock_memory = daemon.lock_memory,
                                      .started = started,
                                      .reload = [&] { return reload(options, next); }})
                              .run();
  if (!end.reload) return {.next = {}, .exit_code = exit_code_of(end)};
  go_on_with_map(*next, setup, bequest_of(pipeline, end));
  return {.next = std::move(next)};
}

int run_with(const Options& options, const EstimatorFactory& make_estimator) {
  const auto started = std::chrono::steady_clock::now();
  if (options.check_config) {
    const FileResult<std::string> right = check_setup(options);
    if (!right) return refuse(text(right.error()));
    std::puts(right->c_str());
    return 0;
  }
  FileResult<DaemonSetup> first = read_setup(options);
  if (!first) return refuse(text(first.error()));
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the file size must stop only the recorder, not the daemon
  set_up_logging(first->daemon.log_level);
  ServiceManager manager;
  PipelineOutcome outcome{.next = std::move(first).value()};
  for (;;) {
    outcome = run_pipeline(*std::move(outcome.next), options, manager, make_estimator, started);
    if (!outcome.next) return outcome.exit_code;
    set_up_logging(outcome.next->daemon.log_level);
    log_event(JournalEvent::configuration_reloaded, "the configuration has been read anew");
  }
}

}  // namespace

int run_daemon(int argc, char** argv, const EstimatorFactory& make_estimator) {
  block_signals();
  limit_thread_stacks();
  const ParsedOptions parsed = parse_options(argc, argv);
  if (parsed.exit_code) return *parsed.exit_code;
  if (parsed.options.print_settings) {
    print_settings();
    return 0;
  }
  if (parsed.options.print_rig_settings) {
    print_rig_settings();
    return 0;
  }
  try {
    return run_with(parsed.options, make_estimator);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "azimuthd: %s\n", visible(error.what()).c_str());
    return kFailed;
  }
}

}  // namespace azimuth
