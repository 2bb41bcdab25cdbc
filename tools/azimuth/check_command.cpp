// azimuth check: judges whether a run agrees with its rig.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <memory>

#include "tools/azimuth/command.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/azimuth/recorded_drive.hpp"
#include "tools/check/plausibility.hpp"
#include "tools/drive_fit/calibration.hpp"

namespace azimuth {
namespace {

struct CheckOptions {
  ReplayOptions run;
  std::filesystem::path out;
  bool force = false;
};

bool is_wrong(const MistakeVerdict& verdict) { return verdict.says == MistakeVerdict::Says::wrong; }

void print(const Plausibility& plausibility, const CheckOptions& options) {
  for (const MistakeVerdict& verdict : plausibility.verdicts) {
    const bool wrong = is_wrong(verdict);
    if (options.run.quiet && !wrong) continue;
    fmt::print("{:<11} {}{}\n", to_string(verdict.mistake), wrong ? "WRONG: " : "", verdict.sentence);
  }
}

void check(const CheckOptions& options) {
  check_outputs({.rig = options.out, .picture = {}, .force = options.force});
  const RecordedDrive recorded = recorded_drive(options.run, NamedBy::eye);
  const ReplaySetup& setup = recorded.setup;
  if (const std::string why = why_cannot_tell(recorded.drive, setup.rig); !why.empty()) {
    if (!options.run.quiet) fmt::print("samples     plausible: units, clocks, rates\nrig         {}\n", why);
    return;
  }
  ProgressBar bar(!options.run.quiet, "fits");
  const Plausibility found = judge(recorded.drive, setup.run, setup.rig, setup.configuration.smoother, bar.listener());
  bar.clear();
  if (!options.run.quiet) {
    fmt::print("samples     plausible: units, clocks, rates\n");
    if (!std::isnan(found.fitting))
      fmt::print("bearings    {:.0f} % fit{}\n", 100.0 * found.fitting,
                 found.anything_wrong() ? " with what is wrong put right" : "");
  }
  print(found, options);
  if (!found.anything_wrong() && found.fitting < kMostMustFit)
    fmt::print(
        "unexplained WRONG: most bearings fit no path, and none of the mistakes above explains it: are the names "
        "of landmarks right?\n");
  if (!options.run.quiet && std::ranges::count_if(found.verdicts, is_wrong) > 1)
    fmt::print("next: put right what stands first, and check again: one mistake can look like another\n");
  if (!options.out.empty()) write_rig(found.rig, "# Made by azimuth check from " + setup.run.name + ".\n", options.out);
  if (found.anything_wrong() || found.fitting < kMostMustFit) throw CommandError{kFailure, ""};
}

}  // namespace

void add_check_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("check", "Judge whether a run's bearings and odometry can be what its rig says");
  const auto options = std::make_shared<CheckOptions>();
  add_drive_options(*command, options->run);
  command->add_option("--out", options->out, "Write a rig.toml: the run's rig with its mistakes put right");
  command->add_flag("--force", options->force, "Replace the file of --out if it exists");
  command->footer(
      "The command uses the run's truth and landmarks.csv, if any, only to tell the scale of distances and which of "
      "two\nmirrored worlds is the true one.\nExit codes: 0 no mistake found, 1 a mistake was found and is named, 2 "
      "wrong use or input.");
  command->callback([options] { check(*options); });
}

}  // namespace azimuth
