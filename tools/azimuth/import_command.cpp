// azimuth import: makes a run from the recordings of other programs.

#include <algorithm>
#include <array>
#include <csignal>
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
#include "tools/azimuth/convert_run.hpp"
#include "tools/azimuth/import_options.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/import/bag_file.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRig = "rig.toml";

volatile std::sig_atomic_t interrupted = 0;

void note(int /*signal*/) { interrupted = 1; }

constexpr int kSignals[] = {SIGINT, SIGTERM};

/// While an object of this class lives, the first Ctrl-C or SIGTERM is only noted, so that half-written output can be
/// removed. The next signal ends the program at once. At most one object may live at a time.
///
/// Thread contract: for single-threaded programs.
class Interruptible {
 public:
  Interruptible() {
    interrupted = 0;
    struct sigaction action {};
    action.sa_handler = note;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    for (const int signal : kSignals) {
      struct sigaction before {};
      ::sigaction(signal, nullptr, &before);
      if (before.sa_handler != SIG_IGN)
        ::sigaction(signal, &action, nullptr);  // nohup and background jobs ignore signals
    }
  }
  ~Interruptible() {
    for (const int signal : kSignals) {
      struct sigaction now {};
      ::sigaction(signal, nullptr, &now);
      if (now.sa_handler == note) std::signal(signal, SIG_DFL);
    }
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Throws CommandError with kInterrupted once a signal was noted.
  static void check() {
    if (interrupted != 0) throw CommandError{kInterrupted, "interrupted: nothing was written"};
  }
};

/// Refuses an input file that the output would replace.
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

/// Prints a note if the stamps of most samples lie outside the odometry's time: such samples give no estimate. The note
/// names the likely unit or clock.
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
  if (const std::string_view packed = packed_as(std::as_bytes(std::span(begin))); !packed.empty() && !is_bag(source))
    refuse(source.string() + ": " + std::string(packed));
}

/// Imports a run in its other form. An LCM log of another program may have channels with other names.
void import_run(const ImportOptions& options) {
  if (options.out.empty()) refuse(options.source.string() + ": is a run already; to copy it, say where: OUT");
  Conversion conversion{.in = options.source, .out = options.out, .force = options.force};
  conversion.log = options.log;
  conversion.log.odometry_alone = true;
  conversion.log.rig_file = options.rig;
  convert(conversion);
}

void import_recording(ImportOptions options) {
  const Interruptible interruptible;
  if (is_run(options.source)) return import_run(options);
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
  command.add_option("--odometry", options.odometry, "Topic of odometry in a bag, where there are several");
  command.add_option("--joints", options.joints,
                     "Names of the wheels in a bag's sensor_msgs/JointState, LEFT,RIGHT, unless the names themselves "
                     "say which is which");
  command.add_option("--sender", options.senders,
                     "Sender whose messages to take where several send on one topic of a bag: a node or channel, or a "
                     "frame of odometry; may be repeated for several topics");
}

void add_table_options(CLI::App& command, ImportOptions& options) {
  command.add_option(
      "--columns", options.columns,
      "Columns of SOURCE, VALUE=COLUMN[UNIT],... for t_s, x_m, y_m and heading_rad (or qx, qy, qz, qw; or left_m and "
      "right_m of wheels; or speed_m_s and turn_rad_s): t_s=stamp[ns],x_m=px,y_m=py,heading_rad=yaw[deg]; "
      "t_s=SECONDS+NANOSECONDS is a stamp in two columns; COLUMN is a name, or a number from 1; a minus sign before "
      "COLUMN turns the value's sign");
  command.add_option("--bearings", options.bearings, "Table of bearings");
  command.add_option(
      "--bearings-columns", options.bearings_columns,
      "Columns of the table of bearings, as in --columns: t_s, azimuth_rad, and elevation_rad, landmark_id, kind, "
      "sigma_rad if the table has them; clockwise azimuths: azimuth_rad=-bearing[deg]");
  command.add_option("--truth", options.truth, "Table of true poses; in a bag, their topic");
  command.add_option("--truth-columns", options.truth_columns, "Columns of the table of true poses, as in --columns");
  command.add_option("--images", options.images, "Folder of images, JPEG or PNG; in a bag, their topic");
  command
      .add_option("--stamps", options.stamps,
                  "Stamps of the images: a table, or name, name[ms], name[us], name[ns] for the last number in the "
                  "files' names")
      ->capture_default_str();
  command.add_option("--stamps-columns", options.stamps_columns,
                     "Columns of the table of --stamps, as in --columns: t_s and file");
  const auto length = CLI::Range(1e-4, 100.0);
  command
      .add_option("--wheel-radius", options.wheels.radius_m,
                  "Radius of both wheels, in metres, for left_rad and right_rad")
      ->check(length);
  command.add_option("--track", options.wheels.track_m, "Distance between the wheels, in metres")->check(length);
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
  CLI::App* command = app.add_subcommand("import", "Make a run from recordings: tables, images, ROS bags, LCM logs");
  const auto options = std::make_shared<ImportOptions>();
  command
      ->add_option("SOURCE", options->source,
                   "Table of odometry; or a ROS bag (ROS 1, MCAP, .db3), or a folder with a bag, whole or in parts; or "
                   "an LCM log")
      ->required();
  command->add_option("OUT", options->out,
                      "Run to write: an LCM log if the name ends in .lcmlog, .lcm or .log, else a run folder; without "
                      "it the topics of a bag are listed");
  add_table_options(*command, *options);
  add_bag_options(*command, *options);
  add_channel_options(*command, options->log);
  command->add_option("--rig", options->rig, "rig.toml to copy into OUT");
  command->add_flag("--force", options->force, "Replace OUT if it exists");
  command->callback([options] { import_recording(*options); });
}

}  // namespace azimuth
