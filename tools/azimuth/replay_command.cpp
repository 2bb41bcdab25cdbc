// azimuth replay: runs the estimator over a recorded run, as fast as possible, and judges the estimates.

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

#include "base/visible.hpp"
#include "drivers/storage/recorded_outputs.hpp"
#include "drivers/wire/channels.hpp"
#include "settings/configured_estimator.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/replay_outputs.hpp"
#include "tools/azimuth/replay_run.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/summary.hpp"
#include "tools/replay/verify.hpp"

namespace azimuth {
namespace {

std::vector<RecordedPose> recorded_poses_of(const ReplayOptions& options, const Run& run) {
  if (!run.from_the_start)
    refuse(options.run.string() + ": --verify needs the first segment of the session, where the estimator started");
  if (options.perceive && run.skipped.missing_frame_segments > 0)
    refuse(options.run.string() + ": --verify needs every image when they are looked at anew, and " +
           std::to_string(run.skipped.missing_frame_segments) +
           " segments of them are gone; daemon.record.frames_quota_mb says how many are kept");
  FileResult<std::vector<RecordedPose>> poses = read_recorded_poses(options.run, options.log);
  if (!poses) refuse(poses.error());
  if (poses->empty())
    refuse(options.run.string() + ": --verify finds no pose on " + options.log.channel_prefix +
           std::string(channel::kPose));
  return *std::move(poses);
}

void report_verification(const ReplayOptions& options, const Run& run, const Verification& verification,
                         std::int64_t first_step) {
  if (verification.passed()) {
    if (!options.quiet) fmt::print("verified    {}\n", verification.text());
    return;
  }
  std::string message = options.run.string() + ": " + verification.text();
  if (!run.recorded_by.empty())
    message += "\nrecorded by " + visible(run.recorded_by) + ", replayed by azimuth " AZIMUTH_VERSION;
  if (const std::string skipped = run.skipped.text(); !skipped.empty()) message += "\nskipped: " + skipped;
  if (first_step > 1)
    message += fmt::format(
        "\nits first pose is of step {}: a log that was begun later than the daemon cannot be verified", first_step);
  if (options.perceive)
    message +=
        "\nthe images were looked at anew: those that were compressed for the log, or not all of them, give other "
        "bearings (daemon.record.frames, frames_rate_hz)";
  throw CommandError{kFailure, message};
}

void replay_run(const ReplayOptions& given, const ReplayOutputs& outputs, HtmlOutput& page, bool verifies) {
  check_outputs(outputs);
  const ReplaySetup setup = replay_setup(given);
  const auto& options = setup.options;
  const Run& run = setup.run;
  const auto recorded = verifies ? recorded_poses_of(options, run) : std::vector<RecordedPose>{};
  const std::string estimator(
      name(chosen_estimator(setup.rig, setup.configuration, setup.map ? &setup.map->map : nullptr)));
  if (!outputs.tum_smoothed.empty() && estimator != "smoother")
    refuse("--tum-smoothed: estimator \"" + estimator +
           "\" decides at once and never again; use --set "
           "estimator=smoother");
  const ReplayResult result = replay_with(setup, page.watch(setup));

  const Report report = report_of(setup, result, estimator, outputs);
  write_outputs(setup, result, report, outputs);
  page.add(setup, result, report);
  if (!options.quiet) {
    if (setup.uses_recorded_configuration()) fmt::print("settings    {}\n", visible(run.configuration_file));
    if (setup.map) fmt::print("map         {}\n", shown(setup.map->file));
    std::fputs(visible_lines(summary(run, result, report, options.run.string())).c_str(), stdout);
  }
  if (verifies) report_verification(options, run, verify(recorded, result), recorded.front().step);
  judge_end(options, result, report);
}

/// Replays the runs one after the other, independently of each other. An error in one run does not stop the others.
void replay_runs(ReplayOptions options, const ReplayOutputs& outputs, bool verifies,
                 const std::vector<std::filesystem::path>& runs) {
  const auto files = outputs.files();
  const bool has_files = !std::ranges::all_of(files, &std::filesystem::path::empty) || !options.pictures.empty() ||
                         !outputs.exports.files.empty();
  if (runs.size() > 1 && has_files)
    refuse("--report, --plot, --tum, --tum-smoothed, --export and --pictures take the outcome of one RUN only");
  HtmlOutput page(outputs.html, runs.size());
  std::size_t failed = 0;
  CommandError worst{kDone, {}};
  for (const std::filesystem::path& run : runs) {
    options.run = run;
    try {
      replay_run(options, outputs, page, verifies);
    } catch (const CommandError& error) {
      if (runs.size() == 1) {
        page.write();
        throw;
      }
      print_error(error.message);
      ++failed;
      worst.code = std::max(worst.code, error.code);
    }
  }
  page.write();
  worst.message = fmt::format("{} of {} runs failed", failed, runs.size());
  if (failed > 0) throw CommandError(worst);
}

}  // namespace

void add_replay_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("replay", "Run the estimator over a recorded run and report how good its estimates are");
  const auto options = std::make_shared<ReplayOptions>();
  const auto outputs = std::make_shared<ReplayOutputs>();
  const auto verifies = std::make_shared<bool>(false);
  const auto runs = std::make_shared<std::vector<std::filesystem::path>>();
  command->add_option("RUN", *runs, std::string(kRunHelp) + "; several are replayed one after the other")->required();
  add_run_options(*command, *options);
  add_start_map_options(*command, *options, "--map");
  add_report_options(*command, *outputs, "Write the report as JSON");
  command->add_option("--plot", outputs->plot, "Draw the map; the name ends in .png, .svg or .pdf");
  command->add_option("--pictures", options->pictures,
                      "Draw images with their seen and expected landmarks into this folder (JPEG)");
  command
      ->add_option("--every", options->every, "Interval of the images that --pictures draws; 10 draws each tenth image")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--tum", outputs->tum, "Write the trajectory in TUM format");
  command->add_option(
      "--tum-smoothed", outputs->tum_smoothed,
      "Write the trajectory in TUM format as it is known at the end, with an estimator that decides in hindsight");
  add_export_options(*command, outputs->exports);
  add_html_options(*command, outputs->html);
  command->add_flag("--verify", *verifies,
                    "Compare the poses with the recorded ones, bit for bit; exit code 1: they differ");
  add_truth_options(*command, *options);
  command->footer(
      "Exit codes: 0 done, 1 poses differ or a file could not be written, 2 wrong use or input, or no estimate, 3 the "
      "run ends lost.");
  command->callback([options, outputs, verifies, runs] { replay_runs(*options, *outputs, *verifies, *runs); });
}

}  // namespace azimuth
