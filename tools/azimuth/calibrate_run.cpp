#include "tools/azimuth/calibrate_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "settings/rig.hpp"
#include "slam/geometry/angle.hpp"
#include "tools/azimuth/calibrate_optics.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/azimuth/told_by_drive.hpp"
#include "tools/calibrate/mirror_picture.hpp"
#include "tools/calibrate/mirror_rig.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/drive_page.hpp"
#include "tools/drive_fit/drive_picture.hpp"
#include "tools/drive_fit/tilt_calibration.hpp"

namespace azimuth {
namespace {

constexpr double kFewestResiduals = 50.0;
constexpr std::size_t kFits = 4;  // heading, tilt, odometry, heading again

struct Start {
  Rig rig;
  std::string rig_file = {};                   ///< empty: the run has no rig
  std::optional<MirrorSearch> by_images = {};  ///< the images gave the camera's model, since the run has no rig
  /// The whole calibration of a camera that looks up at lamps.
  std::optional<FisheyeCalibration> by_lamps = {};
};

/// Refuses what cannot be had below lamps, which tell all parts at once.
void refuse_unfit_below_lamps(const RunCalibrationOptions& options) {
  const std::filesystem::path& picture = options.outputs.picture;
  if (!options.only.empty()) refuse("--only: below lamps, lens and heading are found at once");
  if (!picture.empty() && plot_format(picture) != PlotFormat::png)
    refuse(picture.string() + ": the name of a picture of pixels must end in .png");
}

LampSettings lamp_settings(const ReplayOptions& options) {
  FileResult<Configuration> configuration = read_configuration_file(options.config, options.overrides);
  if (!configuration) refuse(configuration.error());
  return configuration->perception.lamps;
}

Start start_below_lamps(const RunCalibrationOptions& options, const Run& run, Rig rig) {
  refuse_unfit_below_lamps(options);
  std::string problem;
  auto found = calibrate_fisheye(run, rig, lamp_settings(options.run), {}, problem);
  if (!found) refuse(options.run.run.string() + ": " + problem);
  return {.rig = std::move(rig), .rig_file = run.rig_file, .by_lamps = std::move(found)};
}

/// The images show a mirror, or lamps above a fisheye.
Start start_by_images(const RunCalibrationOptions& options, const Run& run, const OdometryRig& odometry) {
  try {
    RigByMirror found = rig_by_mirror(options.run.run, options.run.quiet);
    return {.rig = std::move(found.rig), .by_images = std::move(found.search)};
  } catch (const CommandError& no_mirror) {
    if (no_mirror.code != kFailure) throw;
    std::string problem;
    auto found = calibrate_unknown_fisheye(run, odometry, lamp_settings(options.run), problem);
    if (!found) fail(no_mirror.message + "; nor a fisheye below lamps: " + problem);
    refuse_unfit_below_lamps(options);
    return {.rig = found->rig, .by_lamps = std::move(found)};
  }
}

Start starting_rig(const RunCalibrationOptions& options, const Run& run) {
  if (!run.rig_toml.empty()) {
    FileResult<Rig> read = read_rig(run.rig_toml, run.rig_file);
    if (!read) refuse(read.error());
    if (read->front_end == FrontEnd::lamps && !run.frames.empty())
      return start_below_lamps(options, run, *std::move(read));
    return {*std::move(read), run.rig_file};
  }
  Rig rig;
  rig.odometry.lambda_drift_rad2_per_m = kUnknownDrift_rad2_per_m;
  if (!run.frames.empty()) return start_by_images(options, run, rig.odometry);
  const auto is_named = [](const Bearing& bearing) { return bearing.identity != kUnknownIdentity; };
  rig.camera.identities = std::ranges::any_of(
      run.bearings, [&](const BearingSet& set) { return std::ranges::any_of(set.bearings, is_named); });
  return {rig};
}

/// Whether the found value contradicts the rig's. Without a contradiction the rig keeps its value: of two values that
/// the drive cannot tell apart, the user's own is preferred.
bool contradicts(double found, double said, double sigma) { return std::abs(found - said) > 2.0 * sigma; }

/// Takes the camera's heading and position into the rig.
void take(const HeadingCalibration& found, Rig& rig) {
  if (found.yaw.sigma > 0.0 && found.yaw.sigma < kTakenYaw_rad) {
    const double off_rad = wrap(found.yaw.value - rig.camera.yaw_offset_rad);
    if (contradicts(off_rad, 0.0, found.yaw.sigma)) rig.camera.yaw_offset_rad = found.yaw.value;
    rig.camera.sigma_yaw_rad = found.yaw.sigma;
  }
  if (!found.ahead.told) return;
  std::array<double, 2>& said = rig.camera.position_m;
  if (contradicts(found.ahead.value, said[0], found.ahead.sigma) ||
      contradicts(found.left.value, said[1], found.left.sigma))
    said = {found.ahead.value, found.left.value};
  rig.camera.sigma_position_m = std::max(found.ahead.sigma, found.left.sigma);
}

/// Takes the odometry's calibration into the rig. Noise and floors are those of the solution.
void take(const OdometryCalibration& found, const OdometryRig& said, Rig& rig) {
  rig.odometry = found.solution.guess.rig.odometry;
  const auto keep = [](const FoundNumber& number, double said_value, double& value, double& sigma) {
    if (!number.told || !contradicts(number.value, said_value, number.sigma)) value = said_value;
    if (number.told) sigma = number.sigma;
  };
  keep(found.turn, said.scale_turn, rig.odometry.scale_turn, rig.odometry.sigma_scale_turn);
  if (found.turn.told) rig.odometry.sigma_scale_turn /= rig.odometry.scale_turn;  // the key is relative
  keep(found.drift, said.drift_rad_per_m, rig.odometry.drift_rad_per_m, rig.odometry.sigma_drift_rad_per_m);
  keep(found.lag, said.lag_s, rig.odometry.lag_s, rig.odometry.sigma_lag_s);
}

/// Finds the bearings' noise, if no bearing carries its own standard deviation.
void find_bearing_noise(const RecordedDrive& recorded, const DriveSolution& solution, Rig& rig,
                        ToldByDrive& told_by_drive) {
  const auto says_none = [](const BearingSet& set) {
    return std::ranges::all_of(set.bearings, [](const Bearing& bearing) { return std::isnan(bearing.sigma_rad); });
  };
  if (!told_by_drive.asks_for("bearings") || sees_images(rig) || !std::ranges::all_of(recorded.drive.sets, says_none))
    return;
  const Smoother smoother =
      smoother_of(recorded.drive, solution.graph, solution.guess, {}, recorded.setup.configuration.smoother);
  const Smoother::Noise noise = smoother.bearing_noise();
  if (!(noise.told > kFewestResiduals))
    return told_by_drive.cannot_tell("bearings", "how noisy they are; drive longer");
  // The residuals lack the errors that all bearings of an image share. Therefore the noise is lowered only by the
  // square root of the ratio, but raised by the whole ratio.
  const Rig said = rig;
  rig.camera.sigma_bearing_rad *= noise.ratio < 1.0 ? std::sqrt(noise.ratio) : noise.ratio;
  tell(noise, said, rig, told_by_drive);
}

/// The rig that a drive gives, and its parts.
struct DriveRig {
  std::optional<TiltCalibration> tilt;  ///< present if the images tell elevations
  HeadingCalibration heading;
  OdometryCalibration odometry;
  Rig rig;
  Rig on_drive;  ///< `rig` in the terms of the drive's azimuths, in which the camera's heading is its yaw
  std::vector<PlottedResidual> residuals_before;  ///< for the page alone
};

/// Fits the camera's heading first, since bearings judge the odometry, and again with the corrected odometry. If
/// azimuths grow the other way than the rig says, or if the tilt contradicts the rig, the run is read anew: `recorded`
/// and `said` then have the right values.
DriveRig rig_by_drive(const RunCalibrationOptions& options, const ToldByDrive& told_by_drive, Rig& said,
                      RecordedDrive& recorded) {
  const std::string run = options.run.run.string();
  ProgressBar bar(!options.run.quiet, "fits");
  DriveRig found;
  found.heading = calibrate_heading(recorded.drive, recorded.setup.rig, recorded.setup.configuration.smoother);
  refuse_if_unfit(found.heading.solution, run);
  if (!options.outputs.html.empty())
    found.residuals_before = residuals_with(recorded.drive, found.heading.solution.graph, {.rig = recorded.setup.rig},
                                            recorded.setup.configuration.smoother);
  if (found.heading.hand_told && found.heading.mirrored) {
    if (!told_by_drive.asks_for("heading"))
      refuse(run +
             ": azimuths grow the other way than the rig says, and nothing else can be told before that is right: "
             "--only heading first");
    said = rig_saying({.rig = said, .mirrored = true}, said);
    recorded = recorded_drive(options.run, NamedBy::eye, said);
    found.heading = calibrate_heading(recorded.drive, recorded.setup.rig, recorded.setup.configuration.smoother);
  }
  bar.update(1, kFits);
  if (told_by_drive.asks_for("tilt"))
    found.tilt = calibrate_tilt(recorded.drive, found.heading.solution, recorded.setup.configuration.smoother);
  bar.update(2, kFits);
  if (found.tilt && found.tilt->contradicts) {
    bar.clear();
    said.camera.roll_rad = found.tilt->tilt.roll_rad;
    said.camera.pitch_rad = found.tilt->tilt.pitch_rad;
    said.camera.sigma_tilt_rad = found.tilt->sigma_rad;
    recorded = recorded_drive(options.run, NamedBy::eye, said);
    found.heading = calibrate_heading(recorded.drive, recorded.setup.rig, recorded.setup.configuration.smoother);
  }
  const HindsightSettings& settings = recorded.setup.configuration.smoother;
  Rig rig = recorded.setup.rig;
  take(found.heading, rig);
  found.odometry = calibrate_odometry(recorded.drive, rig, settings);
  refuse_if_unfit(found.odometry.solution, run);
  bar.update(3, kFits);
  take(found.odometry, recorded.setup.rig.odometry, rig);
  found.heading = calibrate_heading(recorded.drive, rig, settings);
  take(found.heading, rig);
  found.on_drive = told_by_drive.with_those_parts(rig, recorded.setup.rig);
  found.rig = told_by_drive.with_those_parts(rig_saying({.rig = rig}, said), said);
  return found;
}

std::string written_rig(const Rig& rig, const ToldByDrive& told_by_drive, const RecordedDrive& recorded) {
  return "# Made by azimuth calibrate from " + recorded.setup.run.name + ".\n\n" + told_by_drive.noted(rig_text(rig));
}

MapPicture picture_of(const RecordedDrive& recorded, const DriveSolution& solution) {
  return drive_picture(recorded.drive, solution, recorded.setup.rig, recorded.setup.configuration.smoother,
                       recorded.setup.run.name + ": calibrated",
                       fmt::format("{:.0f} % of {} bearings fit", 100.0 * solution.fitting, solution.graph.bearings()));
}

/// The residuals with the rig as it was, and with `rig`, which is found.rig with the noise of the bearings.
BearingResiduals residuals_of(const RecordedDrive& recorded, const DriveRig& found, const Rig& rig) {
  DriveGraph graph = found.heading.solution.graph;
  const double noise_ratio = rig.camera.sigma_bearing_rad / found.rig.camera.sigma_bearing_rad;
  for (DriveGraph::Place& place : graph.places)
    for (DriveGraph::Seen& seen : place.seen) seen.bearing.sigma_rad *= noise_ratio;
  return {
      .title = "Residuals of the bearings",
      .before = found.residuals_before,
      .after = residuals_with(recorded.drive, graph, {.rig = found.on_drive}, recorded.setup.configuration.smoother)};
}

/// Collects the page of --html, if there is to be one.
class PageOutput {
 public:
  PageOutput(const RunCalibrationOptions& options, const Start& start) : file_(options.outputs.html) {
    page_.rig_file = start.rig_file;
    if (is_wanted() && start.by_images)
      add("The mirror in the images",
          "The circle must lie on the mirror's rim in the image. Azimuths are measured about its centre.",
          mirror_picture(start.by_images->first.view(), start.by_images->mirror), PlotFormat::png);
  }

  bool is_wanted() const { return !file_.empty(); }
  void add(std::string name, std::string caption, PlotCanvas picture, PlotFormat format) {
    auto source = figure_source(std::move(picture), format);
    if (!source) fail(file_.string() + ": " + source.error());
    page_.figures.push_back({std::move(name), std::move(caption), *std::move(source)});
  }
  void add_drive(const RecordedDrive& recorded, const DriveRig& found, const Rig& rig) {
    add("Path and map",
        "The path and map that fit the bearings best, and the path by wheel odometry alone with the rig as it was and "
        "with the values that were found. The better the odometry, the closer it stays to the estimated path.",
        drawn_map(picture_of(recorded, found.heading.solution), PlotFormat::svg), PlotFormat::svg);
    add("Why: the residuals of the bearings",
        "Measured minus expected azimuth in standard deviations (\u03c3), with the rig as it was (before) and with the "
        "rig.toml below (after). If the rig is right, the histogram follows the dashed curve, and the medians stay at "
        "zero on all sides. A histogram narrower than the curve means that the rig states more noise than this drive "
        "has, which is safe.",
        drawn_residuals(residuals_of(recorded, found, rig), PlotFormat::svg), PlotFormat::svg);
  }
  void write(const Run& run, const ToldByDrive& told_by_drive, const std::string& rig) {
    if (!is_wanted()) return;
    page_.run = run.name;
    page_.made_by = "azimuth " AZIMUTH_VERSION;
    page_.found = told_by_drive.rows();
    page_.untold = told_by_drive.untold();
    page_.rig_text = rig;
    write_text(drive_page(page_), file_);
  }

 private:
  std::filesystem::path file_;
  DrivePage page_;
};

/// The centre that the images gave, as a row of the page. The command prints it before.
FoundValue row_of(const MirrorSearch& search) {
  const MirrorCircle& mirror = search.mirror;
  return {.part = "mirror",
          .key = "camera.centre_px",
          .said = {},
          .found = fmt::format("[{:.2f}, {:.2f}]", mirror.rim.centre_px.x(), mirror.rim.centre_px.y()),
          .two_sigma = fmt::format("{:.2f}", 2.0 * mirror.sigma_centre_px),
          .is_replaced = true,
          .judgement = fmt::format("from {} image{}, before the drive", search.images, search.images == 1 ? "" : "s")};
}

/// Lamps tell the lens, the camera's heading and its tilt at once.
void calibrate_by_lamps(const RunCalibrationOptions& options, const Run& run, const Start& start) {
  const std::filesystem::path& picture = options.outputs.picture;
  const FisheyeCalibration& found = *start.by_lamps;
  if (!options.run.quiet) print_fisheye(run, found, {});
  const std::string text = "# Made by azimuth calibrate from " + run.name + ".\n\n" + rig_text(found.rig);
  if (!options.outputs.rig.empty()) write_rig_text(text, options.outputs.rig);

  const bool has_rig = !start.rig_file.empty();
  ToldByDrive told_by_drive(true, {}, has_rig);
  const LensSolution& solution = found.solution;
  const auto tell = [&](const char* part, const char* key, double said, double value, int which) {
    told_by_drive.also_found({.part = part,
                              .key = key,
                              .said = has_rig ? fmt::format("{:.4f}", said) : "",
                              .found = fmt::format("{:.4f}", value),
                              .two_sigma = fmt::format("{:.4f}", 2.0 * std::sqrt(solution.covariance(which, which))),
                              .is_replaced = true,
                              .judgement = "found with the lens"});
  };
  const CameraRig &was = start.rig.camera, &is = found.rig.camera;
  if (is.image.centre_px)
    told_by_drive.also_found(
        {.part = "lens",
         .key = "camera.centre_px",
         .found = fmt::format("[{:.2f}, {:.2f}]", is.image.centre_px->at(0), is.image.centre_px->at(1)),
         .two_sigma = fmt::format("{:.2f}", 2.0 * std::sqrt(solution.covariance(0, 0))),
         .is_replaced = true,
         .judgement = fmt::format("{} lamps, {:.0f} % of the sightings fit", solution.lamps.size(),
                                  100.0 * solution.fitting())});
  tell("heading", "camera.azimuth_offset_rad", was.image.azimuth_offset_rad, is.image.azimuth_offset_rad, 6);
  if (found.tilt_found) {
    tell("tilt", "camera.roll_rad", was.roll_rad, is.roll_rad, kRoll);
    tell("tilt", "camera.pitch_rad", was.pitch_rad, is.pitch_rad, kPitch);
  }
  told_by_drive.cannot_tell("height", "how high lamps are; azimuth calibrate fisheye --lamp-height METRES takes it");
  PageOutput page(options, start);
  if (page.is_wanted())
    page.add("The lens on the lamps",
             "Centre, circles of equal angle from the axis, and by how much sightings of lamps miss the lens.",
             fisheye_picture(run, found), PlotFormat::png);
  page.write(run, told_by_drive, text);
  if (picture.empty()) return;
  if (const auto problem = fisheye_picture(run, found).write(picture)) fail(picture.string() + ": " + *problem);
}

}  // namespace

void calibrate_by_run(const RunCalibrationOptions& options) {
  check_outputs(options.outputs);
  const std::string run = options.run.run.string();
  LogOptions log = options.run.log;
  log.rig_may_come_later = true;
  const Run images = load_run_or_refuse(options.run.run, log);
  Start start = starting_rig(options, images);
  if (start.by_lamps) return calibrate_by_lamps(options, images, start);
  const Rig said = start.rig;
  RecordedDrive recorded = recorded_drive(options.run, NamedBy::eye, start.rig);
  ToldByDrive told_by_drive(options.run.quiet, options.only, !start.rig_file.empty());
  PageOutput page(options, start);
  if (start.by_images) told_by_drive.also_found(row_of(*start.by_images));
  const auto write = [&](const Rig& rig) {
    const std::string text = written_rig(rig, told_by_drive, recorded);
    if (!options.outputs.rig.empty()) write_rig_text(text, options.outputs.rig);
    page.write(recorded.setup.run, told_by_drive, text);
  };
  if (const std::string why = why_cannot_tell(recorded.drive, recorded.setup.rig); !why.empty()) {
    if (!start.by_images) refuse(run + ": " + why);
    told_by_drive.cannot_tell_anything(why);
    if (!options.outputs.picture.empty())
      print_error(options.outputs.picture.string() + ": not drawn, since there is no path to draw");
    return write(start.rig);
  }
  const DriveRig found = rig_by_drive(options, told_by_drive, start.rig, recorded);
  const double heading_rad =
      wrap(heading_of(found.rig) + found.heading.yaw.value - found.on_drive.camera.yaw_offset_rad);
  tell(found.heading, heading_rad, said, found.rig, told_by_drive);
  if (found.tilt) tell(*found.tilt, said, told_by_drive);
  tell(found.odometry, said.odometry, found.rig.odometry, told_by_drive);
  Rig rig = found.rig;
  find_bearing_noise(recorded, found.heading.solution, rig, told_by_drive);
  if (!told_by_drive.any())
    refuse(run + ": tells nothing of its rig: drive longer, among landmarks, and turn both ways");
  if (page.is_wanted()) page.add_drive(recorded, found, rig);
  write(rig);
  if (options.outputs.picture.empty()) return;
  if (const auto problem = write_map_picture(picture_of(recorded, found.heading.solution), options.outputs.picture))
    fail(options.outputs.picture.string() + ": " + *problem);
}

}  // namespace azimuth
