#include "tools/azimuth/recorded_drive.hpp"

#include <fmt/format.h>
#include <memory>
#include <utility>

#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "settings/sample_sentence.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/eye_tracks.hpp"

namespace azimuth {
namespace {

bool have_looks_alone(const ReplaySetup& setup) {
  return !sees_a_ceiling(setup.rig) && refined_by(setup.rig, setup.configuration) == RefinedBy::filter;
}

std::unique_ptr<Estimator> naming_filter(const ReplaySetup& setup) {
  Configuration by_rig = setup.configuration;
  by_rig.estimator = EstimatorKind::by_rig;
  return configured_estimator(setup.rig, by_rig, nullptr);
}

/// Removes the names from all bearings, where the rig or the command line says that there are none.
void leave_names_out(std::vector<BearingSet>& sets) {
  for (BearingSet& set : sets)
    for (Bearing& bearing : set.bearings) bearing.identity = kUnknownIdentity;
}

}  // namespace

void add_drive_options(CLI::App& command, ReplayOptions& options) {
  command.add_option("RUN", options.run, kRunHelp)->required();
  add_run_options(command, options);
}

RecordedDrive recorded_drive(const ReplayOptions& options, NamedBy named_by, const std::optional<Rig>& rig) {
  RecordedDrive recorded{.setup = replay_setup(options, rig), .drive = {}};
  ReplaySetup& setup = recorded.setup;
  setup.map.reset();
  setup.run.since_map.reset();
  setup.configuration.map.asks_odometry = false;
  setup.configuration.stage = with_patience(setup.configuration.stage);
  const bool nameless = have_looks_alone(setup);
  auto filter = nameless && named_by == NamedBy::filter ? naming_filter(setup) : nullptr;
  const ReplayResult heard =
      replay_with(setup, std::make_unique<DriveListener>(recorded.drive, std::move(filter)), Ending::as_in_the_daemon);
  if (const std::string why = sentence(heard.samples); !why.empty()) refuse(options.run.string() + ": " + why);
  if (recorded.drive.sets.empty()) refuse(options.run.string() + ": has no bearings at a time of its odometry");
  if (refined_by(setup.rig, setup.configuration) == RefinedBy::hypotheses) leave_names_out(recorded.drive.sets);
  recorded.drive.odometry = setup.run.odometry;
  recorded.drive.names_are_landmarks = !nameless;
  if (nameless && named_by == NamedBy::eye) name_by_eye(recorded.drive, setup.rig.odometry);
  return recorded;
}

void refuse_if_unfit(const DriveSolution& solution, const std::string& run) {
  if (solution.fitting < kMostMustFit)
    refuse(
        fmt::format("{0}: only {1:.0f} % of its bearings fit any path: something else is wrong first; azimuth check "
                    "{0} says what",
                    run, 100.0 * solution.fitting));
}

void add_calibration_outputs(CLI::App& command, CalibrationOutputs& outputs) {
  command.add_option("--out", outputs.rig, "Write a rig.toml: the run's rig with the values that were found");
  command.add_flag("--force", outputs.force, "Replace the file of --out if it exists");
  command.add_option("--picture", outputs.picture,
                     "Draw path, map and odometry before and after; the name ends in .png, .svg or .pdf");
}

void check_outputs(const CalibrationOutputs& outputs) {
  check_picture_name(outputs.picture);
  check_writable(outputs.picture);
  for (const std::filesystem::path& file : {outputs.rig, outputs.html}) {
    if (!outputs.force && !file.empty() && std::filesystem::exists(file))
      refuse(file.string() + ": exists already; --force replaces it");
    check_writable(file);
  }
}

void write_rig_text(const std::string& text, const std::filesystem::path& file) {
  if (const FileResult<Rig> read = read_rig(text, file.string()); !read) refuse(read.error());
  write_text(text, file);
}

void write_rig(const Rig& rig, const std::string& comment, const std::filesystem::path& file) {
  write_rig_text(comment + '\n' + rig_text(rig), file);
}

}  // namespace azimuth
