// azimuth map refine: estimates the whole path and map of a recorded run at once.

#include <cstdio>
#include <fmt/format.h>
#include <memory>

#include "base/visible.hpp"
#include "settings/configured_estimator.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/replay_outputs.hpp"
#include "tools/azimuth/replay_run.hpp"
#include "tools/replay/summary.hpp"

namespace azimuth {
namespace {

/// Removes the map that the recorded estimator started from, if refining cannot start from it. Returns the reason, or
/// an empty text if the map is used or there is none.
std::string leave_unfit_map(ReplaySetup& setup) {
  if (!setup.map) return {};
  const auto unfit = why_unfit_to_refine(setup.map->map, setup.rig, setup.configuration);
  if (!unfit) return {};
  setup.map.reset();
  setup.run.since_map.reset();
  setup.configuration.map.asks_odometry = false;
  return std::string(*unfit);
}

void refine(const ReplayOptions& options, const ReplayOutputs& outputs) {
  check_outputs(outputs);
  ReplaySetup setup = replay_setup(options);
  const std::string map_left_out = leave_unfit_map(setup);
  const MapSnapshot* const map = setup.map ? &setup.map->map : nullptr;
  HtmlOutput page(outputs.html, 1);
  const ReplayResult result =
      replay_with(setup, refining_estimator(setup.rig, setup.configuration, map), Ending::concluded, page.watch(setup));
  const Report report =
      report_of(setup, result, name(chosen_refining_estimator(setup.rig, setup.configuration)), outputs);
  if (!options.quiet) {
    fmt::print("refined     {}\n", how_refined(setup.rig, setup.configuration));
    if (setup.map) fmt::print("map         {}\n", shown(setup.map->file));
    if (!map_left_out.empty())
      fmt::print("map         the recording's is not started from: {}\n", visible(map_left_out));
    std::fputs(visible_lines(summary(setup.run, result, report, setup.options.run.string(), true)).c_str(), stdout);
  }
  write_outputs(setup, result, report, outputs, ExportedPoses::refined);
  page.add(setup, result, report);
  page.write();
  judge_end(options, result, report);
}

}  // namespace

void add_map_refine_command(CLI::App& map) {
  CLI::App* command = map.add_subcommand(
      "refine", "Estimate the whole path and map of a recorded run at once, from all its samples: both become better");
  const auto options = std::make_shared<ReplayOptions>();
  const auto outputs = std::make_shared<ReplayOutputs>();
  command->add_option("RUN", options->run, kRunHelp)->required();
  add_run_options(*command, *options);
  add_report_options(*command, *outputs, "Write the report as JSON; \"hindsight\" judges the refined path and map");
  command->add_option("--plot", outputs->plot, "Draw path and map; the name ends in .png, .svg or .pdf");
  command->add_option("--tum", outputs->tum_smoothed, "Write the refined trajectory in TUM format");
  add_export_options(*command, outputs->exports);
  add_html_options(*command, outputs->html);
  command->add_option("--map", outputs->map,
                      "Map file to write, to start from or to export; the earlier map is kept as FILE.previous");
  add_truth_options(*command, *options);
  command->footer(
      "Exit codes: 0 done, 1 a file could not be written, 2 wrong use or input, or no estimate, 3 the run ends lost.");
  command->callback([options, outputs] { refine(*options, *outputs); });
}

}  // namespace azimuth
