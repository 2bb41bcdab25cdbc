// azimuth report compare: compares reports of replays with the reports of another version or other settings.

#include <cstdio>
#include <memory>
#include <vector>

#include "base/files.hpp"
#include "base/visible.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/compare/compare_json.hpp"
#include "tools/compare/compare_text.hpp"
#include "tools/compare/comparison.hpp"
#include "tools/compare/report_files.hpp"

namespace azimuth {
namespace {

using Paths = std::vector<std::filesystem::path>;

struct CompareOptions {
  Paths reports, baseline;
  std::filesystem::path limits, html, json;
  bool without_costs = false, quiet = false;
};

CompareSettings compare_settings(const CompareOptions& options) {
  CompareSettings settings = default_compare_settings();
  if (!options.limits.empty()) {
    const FileResult<std::string> text = read_text_file(options.limits);
    if (!text) refuse(text.error());
    FileResult<CompareSettings> read = read_limits(*text, options.limits.string());
    if (!read) refuse(read.error());
    settings = *std::move(read);
  }
  settings.with_costs = !options.without_costs;
  return settings;
}

Reports reports_or_refuse(const Paths& places, bool quiet) {
  ProgressBar bar(!quiet, "reports");
  Reports reports = read_reports(places, bar.listener());
  bar.clear();
  if (reports.all.empty()) refuse(reports.unreadable);
  return reports;
}

void write_comparison(const CompareOptions& options, const nlohmann::ordered_json& json) {
  if (!options.json.empty()) write_text(json_text(json, 2), options.json);
  if (!options.html.empty()) write_text(comparison_page(json), options.html);
}

void compare_reports(const CompareOptions& options) {
  check_writable(options.html);
  check_writable(options.json);
  const CompareSettings settings = compare_settings(options);
  const Reports after = reports_or_refuse(options.reports, options.quiet);
  const Reports before = options.baseline.empty() ? Reports{} : reports_or_refuse(options.baseline, options.quiet);
  const Comparison comparison = compare(after, options.baseline.empty() ? nullptr : &before, settings);
  const std::vector<std::string> past =
      options.limits.empty() ? std::vector<std::string>{} : past_limits(comparison, settings);
  write_comparison(options, comparison_json(comparison, settings, past, "azimuth " AZIMUTH_VERSION));
  if (!options.quiet) std::fputs(visible_lines(comparison_text(comparison)).c_str(), stdout);
  std::string message;
  for (const std::string& sentence : past) message += (message.empty() ? "" : "\n") + sentence;
  if (!past.empty()) throw CommandError{kFailure, message};
}

}  // namespace

void add_report_compare_command(CLI::App& report) {
  CLI::App* command = report.add_subcommand(
      "compare", "Compare reports of replays, run by run and tag by tag, with those of another version");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("REPORTS", options->reports, "Reports that azimuth replay wrote, or folders of reports (*.json)")
      ->required();
  command->add_option("--baseline", options->baseline,
                      "Reports to compare with, run by run by their names, from another version or other settings");
  command->add_option("--limits", options->limits,
                      "Limits of how much worse runs may be (TOML); past them the exit code is 1");
  command->add_option("--html", options->html, "Write one self-contained page for a browser");
  command->add_option("--json", options->json, "Write all numbers as JSON");
  command->add_flag(
      "--without-costs", options->without_costs,
      "Leave out times and memory, which differ in every replay, so that the same estimates give the same bytes");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->footer(
      "Exit codes: 0 done, 1 a value is past its limit or a file could not be written, 2 wrong use or input, or no "
      "report can be used.");
  command->callback([options] { compare_reports(*options); });
}

}  // namespace azimuth
