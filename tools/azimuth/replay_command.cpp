// azimuth replay: a run through the estimator, as fast as it goes, and how good the outcome is.

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/io/channels.hpp"
#include "drivers/io/recorded_poses.hpp"
#include "drivers/io/truth.hpp"
#include "drivers/io/tum.hpp"
#include "settings/configuration.hpp"
#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/evaluate/report_json.hpp"
#include "tools/replay/picture_folder.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/replay_picture.hpp"
#include "tools/replay/replay_record.hpp"
#include "tools/replay/summary.hpp"
#include "tools/replay/verify.hpp"

namespace azimuth {
namespace {

struct ReplayOptions {
  std::filesystem::path run, config, report, plot, tum, truth, truth_folder, pictures;
  std::size_t every = 10;
  std::string prefix, image_channel = LogOptions{}.image_channel;
  std::string front_end;  // empty: the rig's
  std::vector<std::string> overrides;
  std::optional<int> seed;
  bool verify = false, quiet = false;
};

/// The run, with the truth that was given beside it.
Run run_of(const ReplayOptions& options) {
  Run run = load_run_or_refuse(options.run, {.channel_prefix = options.prefix, .image_channel = options.image_channel});
  FileErrors errors;
  if (!options.truth.empty()) errors = replace_truth(run, options.truth);
  const std::filesystem::path& folder = options.truth_folder;
  if (!folder.empty()) errors = replace_truth(run, folder / "truth.csv", folder / "landmarks.csv");
  if (!errors.empty()) refuse(errors);
  return run;
}

Rig rig_of(const ReplayOptions& options, const Run& run) {
  Outcome<Rig> read = read_rig(run.rig_toml, run.rig_file);
  if (!read) refuse(read.violations());
  Rig rig = std::move(read).value();
  if (!options.front_end.empty()) rig.front_end = *front_end_named(options.front_end);
  return rig;
}

/// `--set front_end=sift` means the rig, not the configuration.
void take_front_end(ReplayOptions& options) {
  constexpr std::string_view kAssignment = "front_end=";
  std::erase_if(options.overrides, [&](const std::string& assignment) {
    if (!assignment.starts_with(kAssignment)) return false;
    options.front_end = assignment.substr(kAssignment.size());
    if (!front_end_named(options.front_end)) refuse("--set " + assignment + ": no such front end");
    return true;
  });
}

/// Recorded bearings are what the robot used; images are looked at when there are none, or when a front end is asked
/// for.
bool looks_at_images(const ReplayOptions& options, const Run& run, const Rig& rig) {
  const bool works_on_images = rig.front_end != FrontEnd::bearings;
  const bool wanted = works_on_images && (run.bearings.empty() || !options.front_end.empty());
  if (wanted && run.frames.empty())
    refuse(options.run.string() + ": has no frames for front end \"" + front_end_name(rig.front_end) + '"');
  if (!wanted && run.bearings.empty())
    refuse(options.run.string() + ": has no bearings, and front_end \"bearings\" looks at no frames");
  return wanted;
}

ImageFrontEnd image_front_end(const Run& run, const Rig& rig, const PerceptionSettings& settings) {
  if (rig.camera.model == "bearings") refuse(run.rig_file + ": camera model \"bearings\" takes no images");
  ImageFrontEnd front_end{make_perception(rig.front_end, rig.camera, settings), decoded_format(rig.front_end)};
  if (!front_end.perception)
    refuse(run.rig_file + ": front_end \"" + front_end_name(rig.front_end) + "\" does not exist yet");
  return front_end;
}

bool uses_recorded_configuration(const ReplayOptions& options, const Run& run) {
  return options.config.empty() && !run.configuration_toml.empty();
}

Configuration configuration_of(const ReplayOptions& options, const Run& run) {
  Outcome<Configuration> read =
      uses_recorded_configuration(options, run)
          ? read_configuration(run.configuration_toml, run.configuration_file, options.overrides)
          : read_configuration_file(options.config, options.overrides);
  if (!read) refuse(read.violations());
  Configuration configuration = std::move(read).value();
  if (options.seed) configuration.fastslam.seed = *options.seed;
  return configuration;
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

std::vector<RecordedPose> recorded_poses_of(const ReplayOptions& options, const Run& run) {
  if (!run.from_the_start)
    refuse(options.run.string() + ": --verify needs the first segment of the session, where the estimator started");
  FileResult<std::vector<RecordedPose>> poses = read_recorded_poses(options.run, {.channel_prefix = options.prefix});
  if (!poses) refuse(poses.errors());
  if (poses->empty())
    refuse(options.run.string() + ": --verify finds no pose on " + options.prefix + std::string(channel::kPose));
  return *std::move(poses);
}

void report_verification(const ReplayOptions& options, const Run& run, const Verification& verification) {
  if (verification.passed()) {
    if (!options.quiet) fmt::print("verified    {}\n", verification.text());
    return;
  }
  std::string message = options.run.string() + ": " + verification.text();
  if (!run.recorded_by.empty())
    message += "\nrecorded by " + run.recorded_by + ", replayed by azimuth " AZIMUTH_VERSION;
  if (const std::string skipped = run.skipped.text(); !skipped.empty()) message += "\nskipped: " + skipped;
  fail(message);
}

/// Runs the images through their front end, and draws some of them if that was asked for.
ReplayResult replay_seen(const ReplayOptions& options, const Run& run, const Rig& rig,
                         const Configuration& configuration, const Progress& progress) {
  ImageFrontEnd front_end = image_front_end(run, rig, configuration.perception);
  auto estimator = configured_estimator(rig, configuration);
  if (options.pictures.empty())
    return replay_images(run, rig, std::move(front_end), std::move(estimator), configuration.stage, progress);
  std::filesystem::create_directories(options.pictures);
  PictureFolder pictures(run, rig.camera, options.pictures, options.every);
  const auto draw = [&](const BearingSet& set, const Estimator& before) { pictures.before_update(set, before); };
  ReplayResult result =
      replay_images(run, rig, std::move(front_end), std::move(estimator), configuration.stage, progress, draw);
  if (!pictures.problem().empty()) fail(pictures.problem());
  return result;
}

void replay_run(const ReplayOptions& options) {
  const Run run = run_of(options);
  const Configuration configuration = configuration_of(options, run);
  const Rig rig = rig_of(options, run);
  const auto recorded = options.verify ? recorded_poses_of(options, run) : std::vector<RecordedPose>{};

  ProgressBar bar(!options.quiet);
  const auto progress = [&bar](std::size_t done, std::size_t all) { bar.update(done, all); };
  const ReplayResult result =
      looks_at_images(options, run, rig)
          ? replay_seen(options, run, rig, configuration, progress)
          : replay(run, rig, configured_estimator(rig, configuration), configuration.stage, progress);
  bar.clear();
  const auto seed = static_cast<std::uint64_t>(configuration.fastslam.seed);

  const Report report = evaluate(replay_record(run, rig, std::string(estimator_name(rig, configuration)), seed, result));
  if (!options.report.empty()) write_text(to_json(report), options.report);
  if (!options.tum.empty()) write_tum_file(result, options.tum);
  if (!options.plot.empty()) write_plot(run, result, report, options.plot);
  if (!options.quiet) {
    if (uses_recorded_configuration(options, run)) fmt::print("settings    {}\n", run.configuration_file);
    std::fputs(summary(run, result, report).c_str(), stdout);
  }
  if (options.verify) report_verification(options, run, verify(recorded, result));
}

void add_truth_options(CLI::App& command, ReplayOptions& options) {
  CLI::Option* const file = command.add_option("--truth", options.truth, "truth.csv to judge the poses by");
  command.add_option("--truth-from", options.truth_folder, "Folder with a truth.csv and a landmarks.csv to judge by")
      ->excludes(file);
}

}  // namespace

void add_replay_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("replay", "Run the estimator over a recorded run and report how good it is");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("RUN", options->run, "Run folder, LCM log or a daemon's session folder")->required();
  command->add_option("--report", options->report, "Write the report as JSON");
  command->add_option("--config", options->config,
                      "Configuration (TOML); without it that of the recording, or every default");
  command->add_option("--set", options->overrides, "Override one key, e.g. ekf.gate_chi2=9; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--front-end", options->front_end,
                   "Look at the run's frames with this front end, or use its bearings; without it as its rig says")
      ->check(CLI::IsMember(front_end_names()));
  command->add_option("--seed", options->seed, "For estimators that draw random numbers; else fastslam.seed")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--plot", options->plot, "Draw the map as a PNG");
  command->add_option("--pictures", options->pictures,
                      "Draw images with what was seen and expected in them into this folder (JPEG)");
  command->add_option("--every", options->every, "Draw the first of so many images each")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--tum", options->tum, "Write the trajectory in TUM format");
  command->add_option("--prefix", options->prefix, "Of the channels in the log");
  command->add_option("--image-channel", options->image_channel, "Of the images (image_t) in the log")
      ->capture_default_str();
  command->add_flag("--verify", options->verify,
                    "Compare the poses with the recorded ones, bit for bit; 1: they differ");
  add_truth_options(*command, *options);
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options] {
    take_front_end(*options);
    replay_run(*options);
  });
}

}  // namespace azimuth
