#include "daemon/daemon_setup.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <utility>
#include <vector>

#include "base/clocks.hpp"
#include "drivers/storage/map_codec.hpp"
#include "settings/configured_estimator.hpp"
#include "slam/perception/make_perception.hpp"

namespace azimuth {
namespace {

FileError cannot_localise(const MapSettings& settings, std::string why) {
  return {settings.file, 0, std::move(why) + ", and map.mode = \"localise\" needs a map"};
}

std::string one_line(const FileErrors& errors) {
  std::string line;
  for (const FileError& error : errors) line += (line.empty() ? "" : "; ") + error.text();
  return line;
}

bool is_same(const MapLandmark& a, const MapLandmark& b) {
  return a.id == b.id && a.identity == b.identity && a.p_map_landmark_m == b.p_map_landmark_m &&
         a.has_height() == b.has_height() && (!a.has_height() || a.z_map_landmark_m == b.z_map_landmark_m);
}

/// The contents of the configuration files, before any object is made from them.
struct Told {
  Configuration configuration;
  DaemonSettings daemon;

  bool has_source() const { return !daemon.play.run.empty() || daemon.live.odometer != OdometerKind::none; }
};

FileResult<Told> read_told(const Options& options) {
  Told told;
  std::vector<Section> sections = daemon_sections(told.daemon);
  FileResult<Configuration> configuration =
      read_configuration_file(options.config_file, options.overrides, pointers(sections));
  if (!configuration) return failure(configuration.error());
  told.daemon.publish.print_poses = options.print_poses;
  if (FileErrors wrong = check(told.daemon); !wrong.empty()) return failure(std::move(wrong));
  told.configuration = *configuration;
  return told;
}

/// Makes the perception stage; none: the samples already contain bearings.
FileResult<std::optional<PerceptionStage>> perception(const Configuration& configuration, const Origin& origin) {
  if (!origin.needs_perception) return std::optional<PerceptionStage>();
  const Rig& rig = origin.rig.rig;
  const auto refuse_rig = [&](const char* why) { return failure(FileError{origin.rig.file, 0, why}); };
  if (!takes_images(rig.camera.model)) return refuse_rig("camera model \"bearings\" takes no images");
  std::unique_ptr<Perception> front_end = make_perception(rig.front_end, rig.camera, configuration.perception);
  if (!front_end) return refuse_rig("its front end does not exist yet");
  return std::optional<PerceptionStage>(std::in_place, std::move(front_end), decoded_format(rig.front_end));
}

/// Limits the relocalisation of a robot whose daemon was restarted a short time ago to the distance that it can have
/// moved since. The limit is written to `[map] reach_m`, so it is recorded and a replay uses the same one.
void limit_search(MapStart& start, const MapSnapshot& map, const MapSettings& settings,
                  Duration epoch_minus_monotonic) {
  if (start.pose_known || start.reach_m > 0.0) return;
  const Duration age = now_on(CLOCK_MONOTONIC) + epoch_minus_monotonic - map.stamp.time_since_epoch();
  start.reach_m = reach_since(age, settings);
}

FileResult<DaemonSetup> make_setup(const Told& told, bool pose_known) {
  const DaemonSettings& daemon = told.daemon;
  if (!told.has_source()) {
    return failure(FileError{"azimuthd", 0,
                             "no source of samples: give a recording with --play RUN (daemon.play.run), or an odometer "
                             "(daemon.live.odometer)"});
  }
  const bool plays = !daemon.play.run.empty();
  FileResult<Origin> origin = plays ? recorded_origin(daemon) : live_origin(daemon);
  if (!origin) return failure(origin.error());
  FileResult<std::optional<PerceptionStage>> perceives = perception(told.configuration, *origin);
  if (!perceives) return failure(perceives.error());
  Configuration start = told.configuration;
  if (pose_known && !plays) start.map.pose_known = true;
  FileResult<SavedMap> saved = saved_map(daemon.map, start, origin->rig.rig);
  if (!saved) return failure(saved.error());
  Configuration configuration = told.configuration;
  if (saved->loaded && origin->epoch_minus_monotonic)
    limit_search(configuration.map, saved->loaded->map, daemon.map, *origin->epoch_minus_monotonic);
  return DaemonSetup{.configuration = std::move(configuration),
                     .daemon = daemon,
                     .origin = std::move(origin).value(),
                     .perception = std::move(perceives).value(),
                     .saved = std::move(saved).value()};
}

FileResult<DaemonSetup> read(const Options& options, bool pose_known) {
  return read_told(options).and_then([&](const Told& told) { return make_setup(told, pose_known); });
}

/// `origin` null: no source of samples is configured.
std::string found_right(const Options& options, const Origin* origin) {
  const std::string settings =
      options.config_file.empty() ? "the default settings (no --config FILE is given)" : options.config_file;
  if (!origin)
    return fmt::format("right: {}; it names neither recording nor odometer, so no rig was checked", settings);
  return fmt::format("right: {} and {}; {}", settings, origin->rig.file, origin->description);
}

/// When a robot only localises, the pose in the map file may be old. So the start uses located_map(), if odometry was
/// kept for it.
void begin_where_it_was(DaemonSetup& setup, const std::filesystem::path& file) {
  std::optional<LoadedMap> map = map_with_robot(*setup.saved.loaded, file);
  if (!map) return;
  SavedOdometry odometry = saved_odometry(*map, file, stamp_clock(*setup.origin.epoch_minus_monotonic));
  if (!odometry.kept) return;
  setup.saved.loaded = std::move(map);
  setup.odometry = std::move(odometry);
}

void look_for_odometry(DaemonSetup& setup) {
  const std::optional<Duration> epoch = setup.origin.epoch_minus_monotonic;
  if (!epoch || !setup.saved.loaded || setup.daemon.map.file.empty()) return;
  const std::filesystem::path file = setup.daemon.map.file;
  setup.odometry = saved_odometry(*setup.saved.loaded, file, stamp_clock(*epoch));
  if (!setup.odometry.kept && setup.configuration.map.mode == MapMode::localise) begin_where_it_was(setup, file);
  setup.configuration.map.asks_odometry = setup.odometry.kept.has_value();
  if (setup.odometry.kept) setup.origin.sources.front()->restore(setup.odometry.kept->odometer);
}

SavedMap without_map(std::string why) { return {.loaded = {}, .status = {.text = std::move(why), .trouble = true}}; }

}  // namespace

FileResult<SavedMap> saved_map(const MapSettings& settings, const Configuration& configuration, const Rig& rig) {
  SavedMap saved;
  const bool localises = configuration.map.mode == MapMode::localise;
  if (settings.file.empty()) return saved;
  if (!map_exists(settings.file)) {
    if (localises) return failure(cannot_localise(settings, "is not there"));
    saved.status.text = settings.file + ": not there yet";
    return saved;
  }
  FileResult<LoadedMap> loaded = read_map(settings.file);
  if (!loaded) {
    if (localises) return failure(cannot_localise(settings, one_line(loaded.error())));
    saved.status = {.text = one_line(loaded.error()) + "; mapping starts from nothing", .trouble = true};
    return saved;
  }
  if (const auto unfit = why_unfit(loaded->map, rig, configuration)) {
    Configuration knowing = configuration;
    knowing.map.pose_known = true;
    const bool wants_pose = !why_unfit(loaded->map, rig, knowing);
    if (localises || !wants_pose)
      return failure(FileError{loaded->file.string(), 0, "cannot be started from: " + std::string(*unfit)});
    saved.status = {
        .text = fmt::format("{}: cannot be started from: {}; mapping starts from nothing, and the map is set aside",
                            loaded->file.string(), *unfit),
        .trouble = true,
        .unfit = true};
    saved.needs_pose = true;
    saved.loaded = *std::move(loaded);
    return saved;
  }
  saved.status = started_from(*loaded);
  saved.loaded = *std::move(loaded);
  return saved;
}

MapKeeperStatus started_from(const LoadedMap& map) {
  MapKeeperStatus status{
      .text = fmt::format("{}: started from its {} landmarks", map.file.string(), map.map.landmarks.size())};
  if (map.troubles.empty()) return status;
  status.text = one_line(map.troubles) + "; " + status.text;
  status.trouble = true;
  return status;
}

double reach_since(Duration age, const MapSettings& settings) {
  constexpr double kSlack_m = 1.0;  // the pose in the map is not exact either
  if (age < Duration{0} || settings.recent_s <= 0.0 || to_seconds(age) > settings.recent_s) return 0.0;
  return kSlack_m + settings.fastest_m_per_s * to_seconds(age);
}

SavedOdometry saved_odometry(const LoadedMap& map, const std::filesystem::path& file, const StampClock& clock) {
  const auto unknown = [](const char* why) {
    return SavedOdometry{.kept = {}, .text = std::string("where the robot went since then is not known: ") + why};
  };
  const char* why = "no odometry was kept";
  std::optional<KeptOdometry> newest;
  const std::uint32_t checksum = map_checksum(map.bytes);
  for (std::optional<KeptOdometry>& kept : read_kept_odometry(kept_odometry_file(file))) {
    if (!kept) continue;
    const bool is_of_map = kept->map_checksum == checksum && kept->since.map == map.map.stamp;
    if (is_of_map) kept = on_clock(*std::move(kept), clock);
    if (!is_of_map)
      why = "the odometry that was kept belongs to another map";
    else if (!kept)
      why = "the machine was switched off, or slept";
    else if (!newest || newest->since.reading.stamp < kept->since.reading.stamp)
      newest = std::move(kept);
  }
  if (!newest) return unknown(why);
  return {.kept = std::move(newest),
          .text = "where the robot went since then its odometer will say, if it has counted on"};
}

std::optional<LoadedMap> map_with_robot(const LoadedMap& map, const std::filesystem::path& file) {
  FileResult<LoadedMap> located = read_map(located_map(file));
  if (!located || located->map.names != map.map.names) return std::nullopt;
  if (!std::ranges::equal(located->map.landmarks, map.map.landmarks, is_same)) return std::nullopt;
  return *std::move(located);
}

FileResult<DaemonSetup> read_setup(const Options& options) { return read(options, false); }
FileResult<DaemonSetup> read_setup_anew(const Options& options) { return read(options, true); }

FileResult<std::string> check_setup(const Options& options) {
  const FileResult<Told> told = read_told(options);
  if (!told) return failure(told.error());
  std::string warnings;
  for (const std::string& warning : told->configuration.warnings) warnings += "\nwarning: " + warning;
  if (!told->has_source()) return found_right(options, nullptr) + warnings;
  const FileResult<DaemonSetup> setup = make_setup(*told, false);
  if (!setup) return failure(setup.error());
  return found_right(options, &setup->origin) + warnings;
}

void find_odometry(DaemonSetup& setup) {
  look_for_odometry(setup);
  if (!std::exchange(setup.saved.needs_pose, false)) return;
  if (setup.odometry.kept)
    setup.saved.status = started_from(*setup.saved.loaded);
  else
    setup.saved.loaded.reset();
}

void go_on_with_map(DaemonSetup& setup, const DaemonSetup& before, Bequest bequest) {
  const Rig& rig = setup.origin.rig.rig;
  if (!bequest.map && !bequest.lost && before.saved.loaded) {  // no step since the start: its map is used again
    bequest.map = before.saved.loaded->map;
    bequest.pose_known = before.configuration.map.pose_known;
  }
  // A recording starts from its own pose, so the robot is not at the last pose of the previous pipeline.
  Configuration going_on = setup.configuration;
  if (bequest.pose_known && !setup.plays()) going_on.map.pose_known = true;
  const bool any = bequest.map && !bequest.map->landmarks.empty();
  const std::optional<std::string_view> unfit = any ? why_unfit(*bequest.map, rig, going_on) : "there is none yet";
  if (!unfit) {
    setup.configuration = std::move(going_on);
    LoadedMap& map = setup.saved.loaded.emplace();
    setup.saved.needs_pose = false;
    map.map = std::move(*bequest.map);
    encode(map.map, map.bytes);
    setup.saved.status = {.text = fmt::format("goes on with its {} landmarks", map.map.landmarks.size())};
    return;
  }
  if (setup.saved.loaded) {  // this map may require a known pose
    if (const auto file_unfit = why_unfit(setup.saved.loaded->map, rig, setup.configuration))
      setup.saved = without_map("mapping starts from nothing: " + std::string(*file_unfit));
  } else if (any) {
    setup.saved.status = {.text = "mapping starts from nothing: " + std::string(*unfit), .trouble = true};
  }
}

}  // namespace azimuth
