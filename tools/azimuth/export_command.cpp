// azimuth export: what a daemon estimated while it recorded, for other programs. Nothing is estimated anew.

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
#include "tools/azimuth/exports.hpp"
#include "tools/export/recorded.hpp"

namespace azimuth {
namespace {

struct RecordedExport {
  std::filesystem::path run;
  ExportWishes wishes;
  LogOptions log;
};

/// How to get what is not recorded.
std::string worked_out_anew(const RecordedExport& options) {
  return "; `azimuth replay " + options.run.string() + " --export " + options.wishes.files.front() +
         "` works out what would have been, `azimuth refine` what can be known";
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

void export_recorded(const RecordedExport& options) {
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
  CLI::App* command =
      app.add_subcommand("export", "Write what a daemon estimated, as it was recorded, for other programs");
  const auto options = std::make_shared<RecordedExport>();
  command->add_option("RUN", options->run, "A daemon's session folder, or an LCM log with its poses")->required();
  command
      ->add_option("FILE", options->wishes.files,
                   "In the format that the name ends with (tum, kitti, kitti_times, csv, geojson, bag, mcap), or that "
                   "stands before it: kitti:poses.txt; several are written one after the other")
      ->required();
  add_origin_option(*command, options->wishes);
  command->add_option("--prefix", options->log.channel_prefix, "Of the channels in the log");
  command->footer("Of other estimates than those that were published: replay --export, refine --export.");
  command->callback([options] { export_recorded(*options); });
}

}  // namespace azimuth
