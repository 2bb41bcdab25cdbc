#include "tools/azimuth/replay_outputs.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fmt/format.h>
#include <utility>

#include "drivers/storage/map_file.hpp"
#include "drivers/storage/tum.hpp"
#include "settings/sample_sentence.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/replay/replay_picture.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {
namespace {

/// Writes the estimates, or the past poses, in TUM format.
template <class Poses>
void write_tum_file(const Poses& poses, const std::filesystem::path& file) {
  std::vector<std::pair<Stamp, Pose2>> trajectory;
  for (const auto& pose : poses) trajectory.emplace_back(pose.stamp, pose.T_map_body);
  fail_on(write_tum(trajectory, file));
}

void write_plot(const ReplaySetup& setup, const ReplayResult& result, const Report& report,
                const std::filesystem::path& file) {
  const auto& classes = setup.configuration.perception.colour.classes;
  if (const auto problem = write_map_picture(replay_picture(setup.run, result, report, classes), file))
    fail(file.string() + ": " + *problem);
}

void write_map_of(const ReplaySetup& setup, const ReplayResult& result, const Report& report,
                  const std::filesystem::path& file) {
  if (!result.map) {
    const std::string why = sentence(result.samples);
    fail(setup.options.run.string() + ": estimator \"" + report.estimator +
         "\" has no map to save in the end (no landmark, or the robot is lost)" + (why.empty() ? "" : ": " + why));
  }
  const std::size_t bytes = write_map_file(*result.map, file);
  if (!setup.options.quiet)
    fmt::print("saved       {}, {} of {} landmarks, {} bytes\n", shown(file), result.map->landmarks.size(),
               result.last.landmarks.size(), bytes);
}

}  // namespace

void check_outputs(const ReplayOutputs& outputs) {
  check_exports(outputs.exports);
  check_picture_name(outputs.plot);
  check_writable(outputs.html.file);
  for (const std::filesystem::path& file : outputs.files()) check_writable(file);
}

void add_report_options(CLI::App& command, ReplayOutputs& outputs, const std::string& report_help) {
  CLI::Option* report = command.add_option("--report", outputs.report, report_help);
  const auto word = [](const std::string& text) {
    constexpr std::size_t kLongest = 200;
    const bool good = !text.empty() && text.size() <= kLongest &&
                      std::ranges::none_of(text, [](unsigned char c) { return std::iscntrl(c) != 0; });
    return good ? std::string() : std::string("must be a text of one line, of 200 bytes at most");
  };
  command
      .add_option("--name", outputs.name, "Name of the run in its report; azimuth report compare pairs reports by name")
      ->check(CLI::Validator(word, ""))
      ->needs(report);
  command
      .add_option("--tag", outputs.tags,
                  "Tag of the run in its report; azimuth report compare sums up runs by tag; may be repeated")
      ->check(CLI::Validator(word, ""))
      ->allow_extra_args(false)
      ->needs(report);
}

Report report_of(const ReplaySetup& setup, const ReplayResult& result, std::string_view estimator,
                 const ReplayOutputs& outputs) {
  const auto seed = static_cast<std::uint64_t>(setup.configuration.fastslam.seed);
  Report report = evaluate(replay_record(setup.run, setup.rig, std::string(estimator), seed, result));
  report.label = {outputs.name, outputs.tags, setup.options.overrides, "azimuth " AZIMUTH_VERSION};
  return report;
}

void write_outputs(const ReplaySetup& setup, const ReplayResult& result, const Report& report,
                   const ReplayOutputs& outputs, ExportedPoses exported) {
  if (!outputs.report.empty()) write_text(to_json(report), outputs.report);
  if (!outputs.tum.empty()) write_tum_file(result.estimates, outputs.tum);
  if (!outputs.tum_smoothed.empty()) write_tum_file(result.past, outputs.tum_smoothed);
  if (!outputs.plot.empty()) write_plot(setup, result, report, outputs.plot);
  if (!outputs.map.empty()) write_map_of(setup, result, report, outputs.map);
  if (!setup.options.quiet) tell_of_exports(outputs.exports);
  if (!result.estimates.empty())  // judge_end() reports a run without estimates
    write_exports(exported == ExportedPoses::refined ? refined_of(setup.run, result) : estimated_of(setup.run, result),
                  outputs.exports);
}

std::size_t write_map_file(const MapSnapshot& map, const std::filesystem::path& file) {
  if (const auto problem = implausible(map)) fail("the map " + *problem);
  if (encoded_size(map) > kMaxMapBytes) fail("the map is too large to be saved");
  std::vector<std::byte> bytes;
  encode(map, bytes);
  fail_on(write_map(bytes, file));
  return bytes.size();
}

void judge_end(const ReplayOptions& options, const ReplayResult& result, const Report& report) {
  const std::string& why = report.input_trouble;
  const AssociationCounts& counts = result.last.association;
  if (report.steps == 0) refuse(options.run.string() + ": no step was made" + (why.empty() ? "" : ": " + why));
  if (counts.accepted + counts.created == 0 && !why.empty())
    refuse(options.run.string() + ": not one bearing was used: " + why);
  if (result.last.health == Health::lost)
    throw CommandError{kEndsLost, shown(options.run) + ": ends lost: " + std::string(result.last.reason) +
                                      (why.empty() ? "" : "; " + why)};
  if (options.quiet && !why.empty()) print_error(shown(options.run) + ": " + why);
}

}  // namespace azimuth
