// azimuth log: what field logs say of themselves. index keeps a catalogue of those in a folder.

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

void add_index(CLI::App& log) {
  CLI::App* command = log.add_subcommand("index", "Keep a catalogue, in SQLite, of the field logs in a folder");
  const auto options = std::make_shared<IndexOptions>();
  command->add_option("FOLDER", options->folder, "Field logs are looked for in it and below it")->required();
  command->add_option("-o,--out", options->out,
                      "Catalogue to make or bring up to date; without it, FOLDER/logs.sqlite");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->footer(
      "Reads what each log recorded, without a replay, and of logs known already only those whose size or time has\n"
      "changed. Logs that are cut, of other versions or without a rig are named; the catalogue says what is missing.\n"
      "Its tables are in docs/fleet.md.");
  command->callback([options] { index(*options); });
}

}  // namespace

void add_log_command(CLI::App& app) {
  CLI::App* log = app.add_subcommand("log", "Say what field logs hold");
  log->require_subcommand(1);
  add_index(*log);
}

}  // namespace azimuth
