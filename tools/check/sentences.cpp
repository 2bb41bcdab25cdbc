#include "tools/check/sentences.hpp"

#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

/// `value` in the unit that texts for the user use.
std::string amount(Mistake mistake, double value) {
  const MistakeRow& row = row_of(mistake);
  return fmt::format("{:.2g} {}", row.per_unit * value, row.unit);
}

std::string would_fit(Mistake mistake, const Rig& said, const RigGuess& found, double sigma) {
  return fmt::format("{} would fit best, +- {}", row_of(mistake).key(said, found), amount(mistake, sigma));
}

/// The command that determines the number accurately.
const char* calibrated_by(Mistake mistake) {
  const bool of_camera = mistake == Mistake::heading || mistake == Mistake::mount;
  return of_camera ? "azimuth calibrate heading" : "azimuth calibrate odometry";
}

bool has_key(Mistake mistake) { return mistake != Mistake::jump; }

}  // namespace

std::string sentence_wrong(Mistake mistake, const Rig& said, const RigGuess& found,
                           const std::optional<RigGuess>& rival) {
  const auto key = [&](Mistake of) { return row_of(of).key(said, found); };
  if (rival)
    return fmt::format(
        "bearings and turns go opposite ways: {} if azimuths grow clockwise, or {} if the wheels are swapped. Which of "
        "the two, neither bearings nor odometry tell: push the robot round to the left, and heading_rad must grow",
        key(Mistake::hand), key(Mistake::wheels));
  const MistakeRow& row = row_of(mistake);
  if (!has_key(mistake)) return row.wrong(said, found);
  const std::string wrong = row.wrong(said, found);
  return fmt::format("{}{} {}", wrong, wrong.ends_with('?') ? "" : ":", row.key(said, found));
}

std::string sentence_either(Mistake mistake) {
  return fmt::format("this or the other one: see {}",
                     to_string(mistake == Mistake::hand ? Mistake::wheels : Mistake::hand));
}

std::string sentence_fits(Mistake mistake, const Rig& said, const RigGuess& found, double sigma) {
  if (is_of_two_worlds(mistake)) return "fits: the other way round does not";
  return fmt::format("fits: {}", would_fit(mistake, said, found, sigma));
}

std::string sentence_costs(const OffsetCost& cost) {
  return fmt::format("{:.2f} m on {:.1f} m driven", cost.off_m, cost.driven_m);
}

std::string sentence_nearly(Mistake mistake, const Rig& said, const RigGuess& found, double sigma,
                            const OffsetCost& cost) {
  const std::string next = !has_key(mistake) || mistake == Mistake::centre || mistake == Mistake::clock
                               ? std::string()
                               : fmt::format(": {} finds it", calibrated_by(mistake));
  return fmt::format("fits nearly: {}; as it is, that costs {}{}", would_fit(mistake, said, found, sigma),
                     sentence_costs(cost), next);
}

std::string sentence_doubtful(Mistake mistake, const Rig& said, const RigGuess& found, double sigma) {
  return fmt::format("cannot tell: {}, but other errors of this drive may look like that; {}",
                     would_fit(mistake, said, found, sigma), row_of(mistake).tells);
}

std::string sentence_cannot_tell(Mistake mistake, double sigma) {
  const MistakeRow& row = row_of(mistake);
  if (is_of_two_worlds(mistake)) return fmt::format("cannot tell: the drive is as likely either way; {}", row.tells);
  if (sigma > 0.0) return fmt::format("cannot tell: known to +- {} only; {}", amount(mistake, sigma), row.tells);
  if (mistake == Mistake::distance)
    return fmt::format("cannot tell: bearings know no lengths; what tells is {}", row.tells);
  if (mistake == Mistake::centre)
    return fmt::format("cannot tell: bearings do not say how far from the image's centre they were seen; {}",
                       row.tells);
  return fmt::format("cannot tell from this drive; {}", row.tells);
}

std::string sentence_hidden_by(Mistake mistake) {
  return fmt::format("cannot tell before {} is put right", to_string(mistake));
}

std::string sentence_leaps(const OdometryLeaps& leaps, double first_s) {
  const std::string how_often = leaps.leaps == 1 ? fmt::format("once, {:.1f} s after the first reading", first_s)
                                                 : fmt::format("{} times in {} readings, first after {:.1f} s",
                                                               leaps.leaps, leaps.readings, first_s);
  const char* cause = leaps.to_origin == leaps.leaps
                          ? "did the odometer start again at zero? Cut the recording there"
                          : "do the wheels' counts wrap (at 8 or 16 bits, or at a full turn)? Unwrap them before they "
                            "are made to poses: `azimuth import` from the wheels' columns does";
  return fmt::format("odometry goes {:.2f} m between two readings, {}, which no wheel does: {}", leaps.typical_m,
                     how_often, cause);
}

std::string sentence_senders(const OdometryLeaps& leaps, double first_s) {
  return fmt::format(
      "odometry goes back and forth by {:.2f} m between readings, {} times in {}, first after {:.1f} s: are those of "
      "two senders mixed? Record one of them alone",
      leaps.typical_m, leaps.undone, leaps.readings, first_s);
}

std::string sentence_stands(double slow_s) {
  return fmt::format("fits: in {:.0f} s of standing odometry stands as well", slow_s);
}

std::string sentence_creeps(const Creep& creep, const OdometryRig& mended) {
  return fmt::format(
      "odometry creeps while the robot stands, by {:.4f} rad and {:.4f} m a second ({:.0f} s in {} {}): let it report "
      "no motion there, or odometry.floor_rotation_rad = {:.4f}, with odometry.floor_distance_m = {:.4f}",
      creep.rad_per_s(), creep.m_per_s(), creep.standing_s, creep.stretches,
      creep.stretches == 1 ? "stretch" : "stretches", mended.floor_rotation_rad, mended.floor_distance_m);
}

std::string sentence_leans(const TiltCalibration& found, const CameraTilt& said) {
  const double off_rad = hypotenuse(found.tilt.roll_rad - said.roll_rad, found.tilt.pitch_rad - said.pitch_rad);
  return fmt::format(
      "the camera leans by {} more than the rig says: camera.roll_rad = {:.4f}, camera.pitch_rad = {:.4f}, each known "
      "to "
      "+- {:.4f}; a centre that seems to be off may be that: azimuth calibrate RUN finds both",
      amount(Mistake::tilt, off_rad), found.tilt.roll_rad, found.tilt.pitch_rad, found.sigma_rad);
}

std::string sentence_leans_as_said(const TiltCalibration& found) {
  return fmt::format("fits: the camera leans as the rig says, +- {}", amount(Mistake::tilt, found.sigma_rad));
}

std::string sentence_distance_wrong(const LengthScale& found, double key) {
  return fmt::format("path and map are 1/{:.3f} of what was measured: odometry.scale_distance = {:.4f}", found.scale,
                     key);
}

std::string sentence_distance_fits(const LengthScale& found) {
  return fmt::format("fits: what was measured is {:.3f} times as large, +- {}", found.scale,
                     amount(Mistake::distance, found.sigma));
}

}  // namespace azimuth
