#include "tools/azimuth/calibrate_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "settings/rig.hpp"
#include "slam/geometry/angle.hpp"
#include "tools/azimuth/calibrate_mirror.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/calibrate/mirror_rig.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/drive_picture.hpp"
#include "tools/drive_fit/tilt_calibration.hpp"

namespace azimuth {
namespace {

// A heading known to three degrees is better than none, and the smoother refines it by its standard deviation.
constexpr double kTakenYaw_rad = 0.05;
constexpr double kFewestResiduals = 50.0;
constexpr std::size_t kFits = 4;  // heading, tilt, odometry, heading again

/// Prints the findings of the requested parts, and keeps them as comments for the rig file.
class ToldByDrive {
 public:
  explicit ToldByDrive(const RunCalibrationOptions& options) : quiet_(options.run.quiet), only_(options.only) {}

  bool asks_for(std::string_view part) const { return only_.empty() || std::ranges::find(only_, part) != only_.end(); }

  /// Prints a line and keeps it as the comment above its key in the file. `sentence` begins with "table.key = ".
  void found(const std::string& part, const std::string& name, const std::string& sentence) {
    if (!asks_for(part)) return;
    print(name, sentence);
    notes_[sentence.substr(0, sentence.find(' '))] = sentence;
  }
  void found(const std::string& part, const std::string& sentence) { found(part, part, sentence); }
  void cannot_tell(const std::string& part, const std::string& name, const std::string& what_would) {
    if (asks_for(part)) print(name, "cannot tell: " + what_would);
  }
  void cannot_tell(const std::string& part, const std::string& what_would) { cannot_tell(part, part, what_would); }
  /// Returns `found` in the requested parts, and `said` in the others.
  Rig with_those_parts(Rig found, const Rig& said) const {
    CameraRig& camera = found.camera;
    const auto keep = [&](std::string_view part, auto& value, const auto& said_value) {
      if (!asks_for(part)) value = said_value;
    };
    keep("heading", camera.yaw_offset_rad, said.camera.yaw_offset_rad);
    keep("heading", camera.image.azimuth_offset_rad, said.camera.image.azimuth_offset_rad);
    keep("heading", camera.sigma_yaw_rad, said.camera.sigma_yaw_rad);
    keep("position", camera.position_m, said.camera.position_m);
    keep("position", camera.sigma_position_m, said.camera.sigma_position_m);
    keep("bearings", camera.sigma_bearing_rad, said.camera.sigma_bearing_rad);
    const OdometryRig odometry = found.odometry;
    if (!asks_for("noise")) found.odometry = said.odometry;
    const auto take_over = [&](std::string_view part, auto OdometryRig::*value) {
      found.odometry.*value = (asks_for(part) ? odometry : said.odometry).*value;
    };
    take_over("turn", &OdometryRig::scale_turn);
    take_over("turn", &OdometryRig::sigma_scale_turn);
    take_over("drift", &OdometryRig::drift_rad_per_m);
    take_over("drift", &OdometryRig::sigma_drift_rad_per_m);
    take_over("lag", &OdometryRig::lag_s);
    take_over("lag", &OdometryRig::sigma_lag_s);
    return found;
  }
  bool any() const { return !notes_.empty(); }

  /// Returns the rig's text with the kept comments above the keys.
  std::string noted(const std::string& rig) const {
    std::istringstream lines(rig);
    std::string text, table;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('[')) table = line.substr(1, line.find(']') - 1) + '.';
      const auto note = notes_.find(table + line.substr(0, line.find(' ')));
      if (note != notes_.end()) text += "# Found: " + note->second + ".\n";
      text += line + '\n';
    }
    return text;
  }

 private:
  void print(const std::string& name, const std::string& sentence) const {
    if (!quiet_) fmt::print("{:<11} {}\n", name, sentence);
  }

  bool quiet_;
  std::vector<std::string> only_;
  std::map<std::string, std::string> notes_;
};

struct Start {
  Rig rig;
  bool by_images = false;  ///< the run has no rig, and the images gave the camera's model
};

Start starting_rig(const ReplayOptions& options) {
  LogOptions log = options.log;
  log.rig_may_come_later = true;
  const Run run = load_run_or_refuse(options.run, log);
  if (!run.rig_toml.empty()) {
    FileResult<Rig> read = read_rig(run.rig_toml, run.rig_file);
    if (!read) refuse(read.error());
    return {*std::move(read)};
  }
  if (!run.frames.empty()) return {rig_by_mirror(options.run, options.quiet), true};
  const auto is_named = [](const Bearing& bearing) { return bearing.identity != kUnknownIdentity; };
  Rig rig;
  rig.odometry.lambda_drift_rad2_per_m = kUnknownDrift_rad2_per_m;
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

void tell(const HeadingCalibration& found, const Rig& rig, ToldByDrive& told_by_drive) {
  if (!found.hand_told)
    told_by_drive.cannot_tell("heading", "direction", "whether azimuths grow clockwise; drive longer, and turn");
  else
    told_by_drive.found("heading", "direction", direction_text(rig));
  if (!(found.yaw.sigma > 0.0 && found.yaw.sigma < kTakenYaw_rad))
    told_by_drive.cannot_tell("heading", "where azimuth 0 is; drive straight on past landmarks");
  else
    told_by_drive.found("heading",
                        fmt::format("{} +- {:.2f} degrees", heading_text(rig), rad_to_degrees(found.yaw.sigma)));
  if (!found.ahead.told)
    told_by_drive.cannot_tell("position", "where the camera stands; turn on the spot both ways, near landmarks");
  else
    told_by_drive.found("position",
                        fmt::format("camera.position_m = [{:.3f}, {:.3f}] +- {:.3f} m", rig.camera.position_m[0],
                                    rig.camera.position_m[1], rig.camera.sigma_position_m));
}

void tell(const TiltCalibration& found, ToldByDrive& told_by_drive) {
  if (!found.told)
    return told_by_drive.cannot_tell("tilt",
                                     "how the camera leans; drive near things that are higher and lower than it");
  const char* const kept = found.contradicts ? "" : ", as it was: the drive does not contradict that";
  for (const auto& [key, value] :
       {std::pair{"roll_rad", found.tilt.roll_rad}, std::pair{"pitch_rad", found.tilt.pitch_rad}})
    told_by_drive.found("tilt", fmt::format("camera.{} = {:.4f} +- {:.4f}{}", key, value, found.sigma_rad, kept));
}

void tell(const OdometryCalibration& found, const OdometryRig& odometry, ToldByDrive& told_by_drive) {
  const auto tell_number = [&](const FoundNumber& number, double taken, const std::string& name, const std::string& key,
                               const char* unit) {
    if (!number.told)
      return told_by_drive.cannot_tell(name, key + "; drive longer, among landmarks, with turns both ways");
    const char* const kept = number.value == taken ? "" : ", as it was: the drive does not contradict that";
    told_by_drive.found(name, fmt::format("odometry.{} = {:.4f} +- {:.4f}{}{}", key, taken, number.sigma, unit, kept));
  };
  tell_number(found.turn, odometry.scale_turn, "turn", "scale_turn", "");
  tell_number(found.drift, odometry.drift_rad_per_m, "drift", "drift_rad_per_m", " rad/m");
  tell_number(found.lag, odometry.lag_s, "lag", "lag_s", " s");
  const auto noise = [&](NoiseSort sort, const char* key, double power, double value) {
    const OdometryNoise::Told& told = found.noise.of(sort);
    if (told.is_told())
      told_by_drive.found("noise", fmt::format("odometry.{} = {:.2g}, {:.2g} +- {:.0f} % is likeliest", key, value,
                                               std::pow(told.variance, power), 100.0 * power * told.sigma_relative));
  };
  noise(NoiseSort::distance, "lambda_distance_m", 1.0, odometry.lambda_distance_m);
  noise(NoiseSort::rotation, "lambda_rotation_rad", 1.0, odometry.lambda_rotation_rad);
  noise(NoiseSort::drift, "lambda_drift_rad2_per_m", 1.0, odometry.lambda_drift_rad2_per_m);
  noise(NoiseSort::lateral, "sigma_lateral_m_per_sqrt_m", 0.5, odometry.sigma_lateral_m_per_sqrt_m);
  if (found.creep.is_told())
    told_by_drive.found("noise", "creep",
                        fmt::format("odometry.floor_rotation_rad = {:.4f}, floor_distance_m = {:.4f}: it goes on by "
                                    "{:.4f} rad and {:.4f} m a second at a standstill",
                                    odometry.floor_rotation_rad, odometry.floor_distance_m, found.creep.rad_per_s(),
                                    found.creep.m_per_s()));
  told_by_drive.cannot_tell(
      "turn", "distance", "bearings know no lengths: azimuth calibrate odometry --measured FROM,TO,METRES, or --truth");
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
  rig.camera.sigma_bearing_rad *= noise.ratio < 1.0 ? std::sqrt(noise.ratio) : noise.ratio;
  told_by_drive.found("bearings", fmt::format("camera.sigma_bearing_rad = {:.4f} +- {:.0f} %",
                                              rig.camera.sigma_bearing_rad, 100.0 / std::sqrt(2.0 * noise.told)));
}

/// The rig that a drive gives, and its parts.
struct DriveRig {
  std::optional<TiltCalibration> tilt;  ///< present if the images tell elevations
  HeadingCalibration heading;
  OdometryCalibration odometry;
  Rig rig;
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
  found.rig = told_by_drive.with_those_parts(rig_saying({.rig = rig}, said), said);
  return found;
}

void write(const Rig& rig, const ToldByDrive& told_by_drive, const RecordedDrive& recorded,
           const RunCalibrationOptions& options) {
  if (options.outputs.rig.empty()) return;
  write_rig_text(
      "# Made by azimuth calibrate from " + recorded.setup.run.name + ".\n\n" + told_by_drive.noted(rig_text(rig)),
      options.outputs.rig);
}

}  // namespace

void calibrate_by_run(const RunCalibrationOptions& options) {
  check_outputs(options.outputs);
  const std::string run = options.run.run.string();
  Start start = starting_rig(options.run);
  RecordedDrive recorded = recorded_drive(options.run, NamedBy::eye, start.rig);
  ToldByDrive told_by_drive(options);
  if (const std::string why = why_cannot_tell(recorded.drive, recorded.setup.rig); !why.empty()) {
    if (!start.by_images) refuse(run + ": " + why);
    if (!options.run.quiet) fmt::print("{:<11} cannot tell: {}\n", "drive", why);
    if (!options.outputs.picture.empty())
      print_error(options.outputs.picture.string() + ": not drawn, since there is no path to draw");
    return write(start.rig, told_by_drive, recorded, options);
  }
  const DriveRig found = rig_by_drive(options, told_by_drive, start.rig, recorded);
  tell(found.heading, found.rig, told_by_drive);
  if (found.tilt) tell(*found.tilt, told_by_drive);
  tell(found.odometry, found.rig.odometry, told_by_drive);
  Rig rig = found.rig;
  find_bearing_noise(recorded, found.heading.solution, rig, told_by_drive);
  if (!told_by_drive.any())
    refuse(run + ": tells nothing of its rig: drive longer, among landmarks, and turn both ways");
  write(rig, told_by_drive, recorded, options);
  if (options.outputs.picture.empty()) return;
  const DriveSolution& solution = found.heading.solution;
  const MapPicture picture =
      drive_picture(recorded.drive, solution, recorded.setup.rig, recorded.setup.configuration.smoother,
                    recorded.setup.run.name + ": calibrated",
                    fmt::format("{:.0f} % of {} bearings fit", 100.0 * solution.fitting, solution.graph.bearings()));
  if (const auto problem = write_map_picture(picture, options.outputs.picture))
    fail(options.outputs.picture.string() + ": " + *problem);
}

}  // namespace azimuth
