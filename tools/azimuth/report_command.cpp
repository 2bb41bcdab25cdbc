// azimuth report: evaluates trajectories, compares reports and lists field logs. Of these commands, this file has
// azimuth report logs, which keeps a catalogue of the field logs in a folder.

#include <fmt/format.h>
#include <memory>

#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/log_index/index_logs.hpp"

namespace azimuth {
namespace {

struct IndexOptions {
  std::filesystem::path folder, out;
  bool quiet = false;
};

void index(const IndexOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(options.folder, ignored)) refuse(options.folder.string() + ": does not exist");
  if (!std::filesystem::is_directory(options.folder, ignored))
    refuse(options.folder.string() + ": is no folder; field logs are looked for in a folder and below it");
  const std::filesystem::path file = options.out.empty() ? options.folder / "logs.sqlite" : options.out;
  check_writable(file);
  ProgressBar bar(!options.quiet, "logs");
  const FileResult<IndexResult> result = index_logs(options.folder, file, bar.listener());
  bar.clear();
  if (!result && is_busy(result.error())) fail(result.error());
  if (!result) refuse(result.error());
  print_error(text(result->troubles));
  if (!options.quiet) fmt::print("{}: {}\n", shown(file), summary_of(*result));
}

}  // namespace

void add_report_command(CLI::App& app) {
  CLI::App* report = app.add_subcommand("report", "Judge a trajectory, compare reports of replays, list field logs");
  report->require_subcommand(1);
  add_report_trajectory_command(*report);
  add_report_compare_command(*report);
  add_report_logs_command(*report);
}

void add_report_logs_command(CLI::App& report) {
  CLI::App* command = report.add_subcommand("logs", "Keep a catalogue (SQLite) of the field logs in a folder");
  const auto options = std::make_shared<IndexOptions>();
  command->add_option("FOLDER", options->folder, "Folder in which and below which field logs are searched for")
      ->required();
  command->add_option("-o,--out", options->out, "Catalogue to make or bring up to date; without it FOLDER/logs.sqlite");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->footer(
      "The command reads what each log recorded, without a replay. It reads a log again only when its size or its "
      "time\n"
      "has changed. It names logs that are cut, of other versions or without a rig, and the catalogue says what is\n"
      "missing. docs/fleet.md has the catalogue's tables.");
  command->callback([options] { index(*options); });
}

}  // namespace azimuth
