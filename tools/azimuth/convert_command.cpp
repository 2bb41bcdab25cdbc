// azimuth convert: a run folder to an LCM log and back.

#include <fmt/format.h>
#include <memory>
#include <string>
#include <system_error>

#include "base/visible.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/import/raw_images.hpp"

namespace azimuth {
namespace {

struct ConvertOptions {
  std::filesystem::path in, out;
  LogOptions log{.odometry_alone = true};
  bool force = false;
};

/// A folder can be looked at, and its rig found, before there is one; a log cannot be given one later.
Run read_input(const ConvertOptions& options) {
  LogOptions log = options.log;
  log.rig_may_come_later = !is_log_name(options.out);
  return load_run_or_refuse(options.in, log);
}

void say_what_came(const ConvertOptions& options, const Run& run) {
  fmt::print("{}: {} odometry readings, {} bearing sets, {} images\n", shown(options.out), run.odometry.size(),
             run.bearings.size(), run.frames.size());
  if (const std::string skipped = run.skipped.text(); !skipped.empty())
    fmt::print("skipped: {}{}\n", skipped, visible(run.perhaps));
  std::error_code ignored;
  const bool has_rig = !run.rig_toml.empty() || std::filesystem::exists(options.out / "rig.toml", ignored);
  if (!has_rig) fmt::print("no rig yet; next: {}\n", visible(first_rig(options.out, !run.frames.empty())));
}

void convert(const ConvertOptions& options) {
  std::error_code error;
  if (std::filesystem::equivalent(options.in, options.out, error))
    refuse(options.out.string() + ": is the input itself");
  check_output(options.out, options.force);
  Run run = read_input(options);
  if (!is_log_name(options.out))
    if (auto brought = bring_raw_images(run, options.out); !brought) refuse(brought.error());
  write_run(run, options.out);
  say_what_came(options, run);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("convert", "Convert between a run folder and an LCM log");
  const auto options = std::make_shared<ConvertOptions>();
  command->add_option("IN", options->in, "Run folder or LCM log")->required();
  command->add_option("OUT", options->out, "LCM log if it ends in .lcmlog, .lcm or .log, else a run folder")
      ->required();
  add_log_options(*command, options->log);
  command->add_flag("--force", options->force, "Replace OUT");
  command->callback([options] { convert(*options); });
}

}  // namespace azimuth
