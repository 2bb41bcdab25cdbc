// azimuth report: evaluates trajectories, compares reports and lists field logs.

#include "tools/azimuth/command.hpp"

namespace azimuth {

void add_report_command(CLI::App& app) {
  CLI::App* report = app.add_subcommand("report", "Judge a trajectory, compare reports of replays, list field logs");
  report->require_subcommand(1);
  add_report_trajectory_command(*report);
  add_report_compare_command(*report);
  add_report_logs_command(*report);
}

}  // namespace azimuth
