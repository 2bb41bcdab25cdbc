// azimuth import: recordings of other programs as a run.

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>

#include "base/files.hpp"
#include "base/packed_file.hpp"
#include "base/visible.hpp"
#include "settings/rig.hpp"
#include "settings/sample_sentence.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/import_options.hpp"
#include "tools/azimuth/interrupt.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/import/bag_file.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRig = "rig.toml";

/// What is written would replace it.
void refuse_own_output(const fs::path& input, const fs::path& out) {
  for (const fs::path& output :
       {out, out / "odometry.csv", out / "bearings.csv", out / "frames.csv", out / "truth.csv"}) {
    std::error_code error;
    if (fs::is_regular_file(input, error) && fs::equivalent(input, output, error))
      refuse(input.string() + ": is what would be written");
  }
}

template <class Samples>
StampSpan span_of(const Samples& samples) {
  StampSpan span;
  for (const auto& sample : samples) span.add(sample.stamp);
  return span;
}

/// Says so when samples lie wholly outside of the odometry's time: nothing will come of them. Or when most do, and
/// would not in another unit.
template <class Samples>
void compare_clocks(const Run& run, const Samples& samples, const char* what) {
  if (samples.empty()) return;
  constexpr int kLeastShare = 10;
  const StampSpan odometry = span_of(run.odometry), other = span_of(samples);
  const Duration common = std::min(odometry.last, other.last) - std::max(odometry.first, other.first);
  if (common >= Duration{} && kLeastShare * common >= other.last - other.first) return;
  print_error(apart_sentence(odometry, other, what));
}

std::string what_next(const ImportOptions& options, const Run& run) {
  const std::string out = options.out.string();
  if (run.bearings.empty() && run.frames.empty())
    return "a map takes bearings or images as well: --bearings FILE, --images FOLDER";
  return run.rig_toml.empty() ? first_rig(options.out, !run.frames.empty())
                              : "azimuth replay " + out + " --plot map.png";
}

void say_what_came(const ImportOptions& options, const Run& run, const std::vector<std::string>& sentences) {
  fmt::print("{}: {} odometry readings over {:.1f} s, {} bearing sets, {} images, {} true poses\n", shown(options.out),
             run.odometry.size(), span_of(run.odometry).seconds(), run.bearings.size(), run.frames.size(),
             run.truth.size());
  if (const std::string skipped = run.skipped.text(); !skipped.empty()) fmt::print("skipped: {}\n", skipped);
  for (const std::string& sentence : sentences) fmt::print("note: {}\n", visible(sentence));
  if (const std::string restarts = restart_sentence(run.odometry); !restarts.empty()) print_error(restarts);
  compare_clocks(run, run.bearings, "bearings");
  compare_clocks(run, run.frames, "images");
  fmt::print("next: {}\n", visible(what_next(options, run)));
}

void refuse_what_is_no_source(const fs::path& source) {
  std::array<char, 64> start{};
  std::ifstream stream(source, std::ios::binary);
  stream.read(start.data(), start.size());
  const std::string_view begin(start.data(), static_cast<std::size_t>(stream.gcount()));
  if (begin.starts_with("\xED\xA1\xDA\x01"))
    refuse(source.string() +
           ": is an LCM log: azimuth replay reads it as it is, azimuth convert makes a run folder of it");
  if (const std::string_view packed = packed_as(std::as_bytes(std::span(begin))); !packed.empty() && !is_bag(source))
    refuse(source.string() + ": " + std::string(packed));
}

void import_recording(ImportOptions options) {
  const Interruptible interruptible;
  std::error_code ignored;
  if (fs::is_directory(options.source, ignored)) {
    FileResult<std::vector<fs::path>> bag = bag_in_folder(options.source);
    if (!bag) refuse(bag.error());
    options.parts = *std::move(bag);
    return import_bag(options);
  }
  refuse_what_is_no_source(options.source);
  options.parts = {options.source};
  is_bag(options.source) ? import_bag(options) : import_tables(options);
}

void add_bag_options(CLI::App& command, ImportOptions& options) {
  command.add_option("--odometry", options.odometry, "Of a bag: the topic of odometry, where there are several");
  command.add_option("--joints", options.joints,
                     "Of a bag: the wheels in sensor_msgs/JointState, LEFT,RIGHT, unless their names say so");
  command.add_option(
      "--sender", options.senders,
      "Of a bag: whose messages to take where several send on one topic: a node or channel, or a frame of "
      "odometry; several for several topics");
}

void add_table_options(CLI::App& command, ImportOptions& options) {
  command.add_option(
      "--columns", options.columns,
      "Of SOURCE: VALUE=COLUMN[UNIT],... for t_s, x_m, y_m and heading_rad (or qx, qy, qz, qw; or left_m "
      "and right_m of wheels; or speed_m_s and turn_rad_s): t_s=stamp[ns],x_m=px,y_m=py,heading_rad=yaw[deg]; "
      "t_s=SECONDS+NANOSECONDS is a stamp in two columns; by name, or by number from 1; a minus sign before it turns "
      "the "
      "value's sign");
  command.add_option("--bearings", options.bearings, "Table of bearings");
  command.add_option("--bearings-columns", options.bearings_columns,
                     "Of that table: t_s, azimuth_rad, and elevation_rad, landmark_id, kind, sigma_rad if it has them; "
                     "clockwise ones: azimuth_rad=-bearing[deg]");
  command.add_option("--truth", options.truth, "Table of true poses; of a bag, their topic");
  command.add_option("--truth-columns", options.truth_columns, "Of that table, as of SOURCE");
  command.add_option("--images", options.images, "Folder of images, JPEG or PNG; of a bag, their topic");
  command
      .add_option("--stamps", options.stamps,
                  "Of the images: a table, or name, name[ms], name[us], name[ns]: the last number in the files' names")
      ->capture_default_str();
  command.add_option("--stamps-columns", options.stamps_columns, "Of that table: t_s and file");
  const auto length = CLI::Range(1e-4, 100.0);
  command
      .add_option("--wheel-radius", options.wheels.radius_m, "Of both wheels, in metres, for left_rad and right_rad")
      ->check(length);
  command.add_option("--track", options.wheels.track_m, "Between the wheels, in metres")->check(length);
}

}  // namespace

void check_import(const ImportOptions& options) {
  check_output(options.out, options.force);
  for (const fs::path& input : {options.source, options.bearings, fs::path(options.truth), fs::path(options.stamps)})
    refuse_own_output(input, options.out);
}

void find_rig(const ImportOptions& options, Run& run) {
  std::error_code ignored;
  const bool has_rig = !is_log_name(options.out) && fs::exists(options.out / kRig, ignored);
  const fs::path file = !options.rig.empty() ? options.rig : has_rig ? options.out / kRig : fs::path();
  if (file.empty()) {
    if (is_log_name(options.out)) refuse(options.out.string() + ": a log holds its rig: give it with --rig FILE");
    return;
  }
  FileResult<std::string> text = read_text_file(file);
  if (!text) refuse(text.error());
  if (const FileResult<Rig> rig = read_rig(*text, file.string()); !rig) refuse(rig.error());
  run.rig_toml = *std::move(text);
  run.rig_file = file.string();
}

WriteProgress shown_and_interruptible(ProgressBar& bar) {
  return [&bar](std::size_t done, std::size_t all) {
    Interruptible::check();
    bar.update(done, all);
  };
}

void finish_import(const ImportOptions& options, const Run& run, const std::vector<std::string>& sentences,
                   UnfinishedRun& unfinished) {
  {
    ProgressBar bar(true);
    unfinished.finish(run, shown_and_interruptible(bar));
  }
  say_what_came(options, run, sentences);
}

void add_import_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("import", "Make a run of the recordings of other programs: tables, images, ROS bags");
  const auto options = std::make_shared<ImportOptions>();
  command
      ->add_option("SOURCE", options->source,
                   "Table of odometry, or a bag of ROS: of ROS 1, MCAP, .db3, or a folder with one, whole or in parts")
      ->required();
  command->add_option(
      "OUT", options->out,
      "LCM log if it ends in .lcmlog, .lcm or .log, else a run folder; of a bag, without it: list what is in it");
  add_table_options(*command, *options);
  add_bag_options(*command, *options);
  command->add_option("--rig", options->rig, "rig.toml to copy into OUT");
  command->add_flag("--force", options->force, "Replace OUT");
  command->callback([options] { import_recording(*options); });
}

}  // namespace azimuth
