// azimuth calibrate odometry: calibrates the odometry from the bearings of a drive.

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>

#include "tools/azimuth/command.hpp"
#include "tools/azimuth/recorded_drive.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/drive_picture.hpp"

namespace azimuth {
namespace {

/// Two landmarks and their measured distance.
struct MeasuredLength {
  Identity from = 0, to = 0;
  double distance_m = 0.0;
};

struct OdometryOptions {
  ReplayOptions run;
  CalibrationOutputs outputs;
  std::string measured;
};

template <class Number>
bool take_number(std::string_view& text, Number& out, bool last) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (last) return text.empty();
  if (!text.starts_with(',')) return false;
  text.remove_prefix(1);
  return true;
}

MeasuredLength measured_length(const std::string& given) {
  MeasuredLength length;
  std::string_view text = given;
  if (!take_number(text, length.from, false) || !take_number(text, length.to, false) ||
      !take_number(text, length.distance_m, true) || !(length.distance_m > 0.0 && std::isfinite(length.distance_m)))
    refuse("--measured " + given + ": must be FROM,TO,METRES, names of two landmarks and how far apart they are");
  return length;
}

std::string told(const FoundNumber& number, const char* key, const char* unit, double said) {
  if (!number.told && !(number.sigma > 0.0))
    return fmt::format(
        "cannot tell from this drive, so {} stays {:g}; a longer drive with turns both ways tells, or `azimuth check` "
        "what is wrong first",
        key, said);
  if (!number.told)
    return fmt::format(
        "cannot tell: known to +- {:.2g}{} only, so {} stays {:g}; a longer drive with turns both ways "
        "tells",
        number.sigma, unit, key, said);
  return fmt::format("{} = {:.4f} +- {:.4f}{} (the rig says {:g})", key, number.value, number.sigma, unit, said);
}

/// Describes one noise parameter. The key's value is the variance to the power `power`.
std::string told(const OdometryNoise::Told& noise, const char* key, double power, double said) {
  if (!noise.is_told())
    return fmt::format("cannot tell {}, which stays {:g}; a longer drive with turns both ways tells", key, said);
  const std::string written = fmt::format("{} = {:.2g} ", key, std::pow(noise.safe_variance, power));
  const std::string likeliest = fmt::format("{:.2g} +- {:.0f} % is likeliest", std::pow(noise.variance, power),
                                            100.0 * power * noise.sigma_relative);
  if (noise.is_held())
    return written + fmt::format("({}, but one drive does not prove so little beside the {:g} that the rig says)",
                                 likeliest, said);
  return written + fmt::format("({}; the rig says {:g})", likeliest, said);
}

void print_noise(const OdometryNoise& noise, const OdometryRig& said) {
  const auto line = [](const std::string& text) { fmt::print("noise       {}\n", text); };
  line(told(noise.of(NoiseSort::distance), "lambda_distance_m", 1.0, said.lambda_distance_m));
  line(told(noise.of(NoiseSort::rotation), "lambda_rotation_rad", 1.0, said.lambda_rotation_rad));
  line(told(noise.of(NoiseSort::drift), "lambda_drift_rad2_per_m", 1.0, said.lambda_drift_rad2_per_m));
  line(told(noise.of(NoiseSort::lateral), "sigma_lateral_m_per_sqrt_m", 0.5, said.sigma_lateral_m_per_sqrt_m));
}

std::string told(const Creep& creep, const OdometryRig& found) {
  if (!(creep.slow_s > 0.0))
    return "cannot tell what the odometer does at a standstill; let the robot stand for ten seconds in sight of "
           "landmarks";
  if (!creep.is_told()) return fmt::format("none in {:.0f} s of standing", creep.slow_s);
  return fmt::format("{:.4f} rad and {:.4f} m a second: floor_rotation_rad = {:.4f}, floor_distance_m = {:.4f}",
                     creep.rad_per_s(), creep.m_per_s(), found.floor_rotation_rad, found.floor_distance_m);
}

/// The scale of true to found lengths, if a measured distance or the truth is given.
std::optional<LengthScale> length_scale(const OdometryOptions& options, const RecordedDrive& recorded,
                                        const DriveSolution& solution) {
  const ReplaySetup& setup = recorded.setup;
  if (!options.measured.empty()) {
    const MeasuredLength length = measured_length(options.measured);
    const auto scale = scale_between(recorded.drive, solution, setup.configuration.smoother, length.from, length.to,
                                     length.distance_m);
    if (!scale) refuse("--measured " + options.measured + ": the map has not both of these landmarks");
    return scale;
  }
  if (setup.options.truth.empty() && setup.options.truth_folder.empty()) return std::nullopt;
  const auto like = likeness(points_on_path(solution, setup.run.truth));
  if (!like) refuse(options.run.run.string() + ": the truth given is not of this drive's time, or stands still");
  if (like->hand_told && like->mirrored)
    refuse(options.run.run.string() + ": the path is the truth's mirror image: azimuth check says what may be wrong");
  return like->lengths;
}

std::string told(const std::optional<LengthScale>& lengths, const OdometryRig& said, const OdometryRig& found) {
  if (!lengths)
    return "cannot tell: bearings know no lengths; --truth FILE or --measured FROM,TO,METRES, the distance of two "
           "landmarks";
  return fmt::format("scale_distance = {:.4f} +- {:.4f} (the rig says {:g})", found.scale_distance,
                     said.scale_distance * lengths->sigma, said.scale_distance);
}

/// Applies the scale of lengths. The heading's drift is the same for the whole path, so a longer path drifts less per
/// metre.
void take_lengths(const LengthScale& lengths, OdometryRig& odometry) {
  odometry.scale_distance *= lengths.scale;
  odometry.drift_rad_per_m /= lengths.scale;
  odometry.sigma_scale_distance = std::max(lengths.sigma / lengths.scale, 1e-4);
}

void calibrate(const OdometryOptions& options) {
  check_outputs(options.outputs);
  if (!options.measured.empty()) measured_length(options.measured);  // refuses before any work
  // The names in --measured are those of the filter's map.
  const RecordedDrive recorded = recorded_drive(options.run, options.measured.empty() ? NamedBy::eye : NamedBy::filter);
  const ReplaySetup& setup = recorded.setup;
  const std::string run = options.run.run.string();
  if (const std::string why = why_cannot_tell(recorded.drive, setup.rig); !why.empty()) refuse(run + ": " + why);
  const HindsightSettings& settings = setup.configuration.smoother;
  const OdometryCalibration found = calibrate_odometry(recorded.drive, setup.rig, settings);
  refuse_if_unfit(found.solution, run);
  if (found.turn.value < 0.0 && found.turn.told)
    refuse(run + ": bearings and turns go opposite ways: azimuth check " + run + " says what may be the cause");
  const OdometryRig& said = setup.rig.odometry;
  Rig rig = found.solution.guess.rig;
  const auto lengths = length_scale(options, recorded, found.solution);
  if (lengths) take_lengths(*lengths, rig.odometry);
  // Floor and load change from day to day, so the drive's value only replaces a larger standard deviation.
  if (found.turn.told)
    rig.odometry.sigma_scale_turn = std::min(said.sigma_scale_turn, found.turn.sigma / found.turn.value);
  if (!options.run.quiet) {
    fmt::print("drive       {:.0f} s, {} bearings used, {:.0f} % of them fit\n",
               to_seconds(recorded.drive.sets.back().stamp - recorded.drive.sets.front().stamp),
               found.solution.graph.bearings(), 100.0 * found.solution.fitting);
    fmt::print("turn        {}\n", told(found.turn, "scale_turn", "", said.scale_turn));
    fmt::print("drift       {}\n", told(found.drift, "drift_rad_per_m", " rad/m", said.drift_rad_per_m));
    fmt::print("lag         {}\n", told(found.lag, "lag_s", " s", said.lag_s));
    fmt::print("distance    {}\n", told(lengths, said, rig.odometry));
    print_noise(found.noise, said);
    fmt::print("creep       {}\n", told(found.creep, rig.odometry));
  }
  if (!found.turn.told && !found.drift.told && !found.lag.told && !lengths)
    refuse(run + ": tells nothing of its odometry: drive longer, among landmarks, and turn both ways");
  if (!options.outputs.rig.empty())
    write_rig(rig, "# Made by azimuth calibrate odometry from " + setup.run.name + ".\n", options.outputs.rig);
  if (options.outputs.picture.empty()) return;
  const MapPicture picture =
      drive_picture(recorded.drive, found.solution, setup.rig, settings, setup.run.name + ": odometry calibrated",
                    fmt::format("scale of turns {:.4f}, drift {:.4f} rad/m, lag {:.3f} s", rig.odometry.scale_turn,
                                rig.odometry.drift_rad_per_m, rig.odometry.lag_s));
  if (const auto problem = write_map_picture(picture, options.outputs.picture))
    fail(options.outputs.picture.string() + ": " + *problem);
}

}  // namespace

void add_calibrate_odometry_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "odometry", "Find the odometry's scale of turns, drift, lag and noise from a drive, by bearings alone");
  const auto options = std::make_shared<OdometryOptions>();
  add_drive_options(*command, options->run);
  add_truth_options(*command, options->run);
  command
      ->add_option("--measured", options->measured,
                   "Measured distance of two landmarks, which tells the scale of distances as --truth does")
      ->type_name("FROM,TO,METRES");
  add_calibration_outputs(*command, options->outputs);
  command->footer("Exit codes: 0 done, 1 a file could not be written, 2 wrong use or input, or the drive cannot tell.");
  command->callback([options] { calibrate(*options); });
}

}  // namespace azimuth
