#include "tools/azimuth/replay_run.hpp"

#include <cstdio>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "drivers/storage/run.hpp"
#include "drivers/storage/session.hpp"
#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/replay/picture_folder.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {
namespace {

/// Reads the run, with the truth that the options give.
Run run_of(const ReplayOptions& options) {
  Run run = load_run_or_refuse(options.run, options.log);
  FileErrors errors;
  if (!options.truth.empty()) errors = replace_truth(run, options.truth);
  const std::filesystem::path& folder = options.truth_folder;
  if (!folder.empty()) errors = replace_truth(run, folder / "truth.csv", folder / "landmarks.csv");
  if (!errors.empty()) refuse(errors);
  return run;
}

Rig read_or_refuse(const Run& run) {
  FileResult<Rig> read = read_rig(run.rig_toml, run.rig_file);
  if (!read) refuse(read.error());
  return std::move(read).value();
}

Rig rig_of(const ReplayOptions& options, Rig rig) {
  if (!options.front_end.empty()) rig.front_end = *front_end_named(options.front_end);
  if (options.no_names) rig.camera.identities = false;
  return rig;
}

/// Moves `--set front_end=sift` to the front end of the rig, since it is not a key of the configuration.
void take_front_end(ReplayOptions& options) {
  constexpr std::string_view kAssignment = "front_end=";
  std::erase_if(options.overrides, [&](const std::string& assignment) {
    if (!assignment.starts_with(kAssignment)) return false;
    options.front_end = assignment.substr(kAssignment.size());
    if (!front_end_named(options.front_end)) refuse("--set " + assignment + ": no such front end");
    return true;
  });
}

/// Whether the replay uses the images. It uses the recorded bearings, as the robot did, unless there are none or the
/// options ask for the images.
bool looks_at_images(const ReplayOptions& options, const Run& run, const Rig& rig) {
  const bool works_on_images = rig.front_end != FrontEnd::bearings;
  if (options.perceive && !works_on_images)
    refuse(run.rig_file + ": front_end \"bearings\" looks at no images; name one with --front-end");
  const bool wanted = works_on_images && (run.bearings.empty() || !options.front_end.empty() || options.perceive);
  if (wanted && run.frames.empty())
    refuse(options.run.string() + ": has no frames for front end \"" + front_end_name(rig.front_end) + '"');
  if (!wanted && run.bearings.empty())
    refuse(options.run.string() + ": has no bearings, and front_end \"bearings\" looks at no frames");
  return wanted;
}

ImageFrontEnd image_front_end(const Run& run, const Rig& rig, const PerceptionSettings& settings) {
  if (!takes_images(rig.camera.model)) refuse(run.rig_file + ": camera model \"bearings\" takes no images");
  ImageFrontEnd front_end{make_perception(rig.front_end, rig.camera, settings), decoded_format(rig.front_end)};
  if (!front_end.perception)
    refuse(run.rig_file + ": front_end \"" + front_end_name(rig.front_end) + "\" does not exist yet");
  return front_end;
}

bool has_its_configuration(const ReplayOptions& options, const Run& run) {
  return options.config.empty() && !run.configuration_toml.empty();
}

Configuration configuration_of(const ReplayOptions& options, const Run& run) {
  FileResult<Configuration> read =
      has_its_configuration(options, run)
          ? read_configuration(run.configuration_toml, run.configuration_file, options.overrides)
          : read_configuration_file(options.config, options.overrides);
  if (!read) refuse(read.error());
  Configuration configuration = std::move(read).value();
  if (options.seed) configuration.fastslam.seed = *options.seed;
  if (options.localise) configuration.map.mode = MapMode::localise;
  return configuration;
}

/// The map of the options, else the map that the recorded estimator started from.
std::optional<LoadedMap> map_of(const ReplayOptions& options, const Run& run) {
  if (!options.map.empty()) {
    FileResult<LoadedMap> read = read_map(options.map);
    if (!read) refuse(read.error());
    return *std::move(read);
  }
  if (run.map.empty()) return std::nullopt;
  LoadedMap recorded;
  recorded.file = options.run.string() + " (" + kMapDocument + ')';
  if (const auto problem = decode_map(std::as_bytes(std::span(run.map)), recorded.map))
    refuse(recorded.file.string() + ": " + *problem);
  return recorded;
}

/// Replays the images through their front end, and draws some of them if requested.
ReplayResult replay_seen(const ReplaySetup& setup, std::unique_ptr<Estimator> estimator, const Progress& progress,
                         Ending ending, const ReplayWatch& watch) {
  const ReplayOptions& options = setup.options;
  const Run& run = setup.run;
  const Rig& rig = setup.rig;
  const Configuration& configuration = setup.configuration;
  ImageFrontEnd front_end = image_front_end(run, rig, configuration.perception);
  if (options.pictures.empty())
    return replay_images(run, rig, std::move(front_end), std::move(estimator), configuration.stage, progress, ending,
                         watch);
  std::filesystem::create_directories(options.pictures);
  PictureFolder pictures(run, rig.camera, options.pictures, options.every);
  const auto draw = [&](const BearingSet& set, const Estimator& before) {
    pictures.before_update(set, before);
    if (watch.before_update) watch.before_update(set, before);
  };
  ReplayResult result = replay_images(run, rig, std::move(front_end), std::move(estimator), configuration.stage,
                                      progress, ending, {.before_update = draw, .after_step = watch.after_step});
  if (!pictures.problem().empty()) fail(pictures.problem());
  return result;
}

}  // namespace

bool ReplaySetup::uses_recorded_configuration() const { return has_its_configuration(options, run); }

ReplaySetup replay_setup(ReplayOptions given, const std::optional<Rig>& rig) {
  take_front_end(given);
  given.log.rig_may_come_later = rig.has_value();
  ReplaySetup setup{.options = std::move(given), .run = {}, .configuration = {}, .rig = {}, .map = {}};
  const ReplayOptions& options = setup.options;
  setup.run = run_of(options);
  setup.configuration = configuration_of(options, setup.run);
  setup.rig = rig_of(options, rig ? *rig : read_or_refuse(setup.run));
  setup.map = map_of(options, setup.run);
  if (!options.map.empty()) setup.run.since_map.reset();  // odometry since the recording's map does not fit another map
  setup.configuration.map.asks_odometry = setup.run.since_map.has_value();
  if (!setup.map) {
    if (options.localise) refuse("--localise needs a map to find the robot in: --map FILE");
    return setup;
  }
  if (const auto unfit = why_unfit(setup.map->map, setup.rig, setup.configuration))
    refuse(setup.map->file.string() + ": cannot be started from: " + std::string(*unfit));
  return setup;
}

ReplayResult replay_with(const ReplaySetup& setup, const ReplayWatch& watch) {
  return replay_with(setup, configured_estimator(setup.rig, setup.configuration, setup.map ? &setup.map->map : nullptr),
                     Ending::as_in_the_daemon, watch);
}

ReplayResult replay_with(const ReplaySetup& setup, std::unique_ptr<Estimator> estimator, Ending ending,
                         const ReplayWatch& watch) {
  if (setup.map && !setup.map->troubles.empty())
    std::fputs((text(setup.map->troubles) + "; used " + shown(setup.map->file) + '\n').c_str(), stderr);
  const bool of_images = looks_at_images(setup.options, setup.run, setup.rig);
  ProgressBar bar(!setup.options.quiet, of_images ? "images" : "sets of bearings");
  const Progress progress = bar.listener();
  ReplayResult result = of_images ? replay_seen(setup, std::move(estimator), progress, ending, watch)
                                  : replay(setup.run, setup.rig, std::move(estimator), setup.configuration.stage,
                                           progress, ending, watch);
  bar.clear();
  return result;
}

void add_run_options(CLI::App& command, ReplayOptions& options) {
  command.add_option("--config", options.config,
                     "Configuration (TOML); without it the recording's configuration, or else every default");
  command.add_option("--set", options.overrides, "Override one key, e.g. ekf.thinning_s=1; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option(
          "--front-end", options.front_end,
          "Front end for the run's images, or bearings to use its ready-made bearings; without it as the rig says")
      ->check(CLI::IsMember(front_end_names()));
  command.add_flag(
      "--perceive", options.perceive,
      "Use the recorded images in place of the recorded bearings. If every image was recorded raw, the poses are the "
      "recorded ones to the last bit; JPEG, from a camera that does not itself send JPEG, loses a little");
  command.add_flag(
      "--no-names", options.no_names,
      "Ignore the names that bearings carry, so that all landmarks are alike, as with identities = false in the rig");
  command.add_option("--seed", options.seed, "Seed of estimators that draw random numbers; without it fastslam.seed")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  command.add_option("--prefix", options.log.channel_prefix, "Prefix of the channels in the log");
  add_log_options(command, options.log);
  command.add_flag("--quiet", options.quiet, "Print nothing but errors");
}

void add_start_map_options(CLI::App& command, ReplayOptions& options, const std::string& map_option) {
  command.add_option(map_option, options.map, "Map file to start from, as the table [map] of the configuration says");
  command.add_flag("--localise", options.localise,
                   "Keep the map that the estimator starts from as it is, and only find the robot in it");
}

void add_truth_options(CLI::App& command, ReplayOptions& options) {
  CLI::Option* const file = command.add_option("--truth", options.truth, "truth.csv with the true poses to judge by");
  command
      .add_option("--truth-from", options.truth_folder, "Folder with the truth.csv and the landmarks.csv to judge by")
      ->excludes(file);
}

}  // namespace azimuth
