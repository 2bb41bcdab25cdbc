// azimuth export: writes the recorded estimates of a daemon for other programs. Nothing is estimated anew.

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <system_error>

#include "base/visible.hpp"
#include "drivers/storage/recorded_outputs.hpp"
#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/convert_run.hpp"
#include "tools/azimuth/exports.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/export/estimated.hpp"

namespace azimuth {
namespace {

struct RecordedExport {
  std::filesystem::path run;
  ExportWishes wishes;
  LogOptions log;
  bool force = false;
};

/// Names the commands that estimate what is not recorded.
std::string worked_out_anew(const RecordedExport& options) {
  return "; `azimuth replay " + options.run.string() + " --export " + options.wishes.files.front() +
         "` estimates what the daemon would have, `azimuth map refine` what the whole drive tells";
}

bool is_run_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) && session_segments(path).empty();
}

RecordedOutputs outputs_of(const RecordedExport& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(options.run, ignored)) refuse(options.run.string() + ": is not there");
  if (is_run_folder(options.run))
    refuse(options.run.string() + ": holds what a robot sensed, and no poses" + worked_out_anew(options));
  FileResult<RecordedOutputs> outputs = read_recorded_outputs(options.run, options.log);
  if (!outputs) refuse(outputs.error());
  if (outputs->poses.empty())
    refuse(options.run.string() + ": holds no pose on " + options.log.channel_prefix + std::string(channel::kPose) +
           (options.log.channel_prefix.empty() ? " (--prefix is for a daemon that published under one)" : "") +
           worked_out_anew(options));
  return *std::move(outputs);
}

void tell_losses(const RecordedOutputs& outputs) {
  if (outputs.poses_not_in_order > 0)
    fmt::print(stderr, "left out: {} poses that are not newer than the one before\n", outputs.poses_not_in_order);
  if (outputs.malformed > 0) fmt::print(stderr, "left out: {} malformed messages\n", outputs.malformed);
}

/// Whether the user wants the samples themselves, as one LCM log.
bool wants_log(const RecordedExport& options) {
  return options.wishes.files.size() == 1 && is_log_name(options.wishes.files.front());
}

void export_recorded(const RecordedExport& options) {
  if (wants_log(options))
    return convert({.in = options.run, .out = options.wishes.files.front(), .force = options.force});
  check_exports(options.wishes);
  const RecordedOutputs outputs = outputs_of(options);
  const Estimated estimated = estimated_of(outputs, options.run.stem().string());
  write_exports(estimated, options.wishes);
  for (const std::string& file : options.wishes.files)
    fmt::print("{}: {} poses, {} landmarks\n", visible(file), estimated.poses.size(), estimated.landmarks.size());
  tell_of_exports(options.wishes);
  tell_losses(outputs);
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("export", "Write the recorded estimates of a daemon for other programs");
  const auto options = std::make_shared<RecordedExport>();
  command
      ->add_option("RUN", options->run,
                   "Session folder of a daemon, or an LCM log with its poses; for FILE.lcmlog any run")
      ->required();
  command
      ->add_option("FILE", options->wishes.files,
                   "File to write, in the format that its name ends with (tum, kitti, kitti_times, csv, geojson, bag, "
                   "mcap), or that stands before the name: kitti:poses.txt; several files may be given. FILE.lcmlog "
                   "alone: the samples themselves as an LCM log")
      ->required();
  add_origin_option(*command, options->wishes);
  command->add_option("--prefix", options->log.channel_prefix, "Prefix of the channels in the log");
  command->add_flag("--force", options->force, "Replace an LCM log that exists");
  command->footer(
      "azimuth replay --export and azimuth map refine --export write new estimates instead of the recorded ones.");
  command->callback([options] { export_recorded(*options); });
}

}  // namespace azimuth
