#include "settings/sample_sentence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

std::string span(const StampSpan& span) {
  return fmt::format("{:.0f} to {:.0f} s", to_seconds(span.first), to_seconds(span.last));
}

struct StampUnit {
  std::string_view name, short_name;
  double per_s;
};
constexpr std::array<StampUnit, 3> kStampUnits{
    {{"milliseconds", "ms", 1e3}, {"microseconds", "us", 1e6}, {"nanoseconds", "ns", 1e9}}};

/// Whether both spans begin and end at about the same times once the stamps of `larger` are divided by `divisor`.
bool are_alike(const StampSpan& larger, const StampSpan& smaller, double divisor) {
  const double begin_s = to_seconds(larger.first) / divisor, end_s = to_seconds(larger.last) / divisor;
  const double common_s = std::min(end_s, to_seconds(smaller.last)) - std::max(begin_s, to_seconds(smaller.first));
  return common_s > 0.0 && 2.0 * common_s >= std::min(smaller.seconds(), end_s - begin_s) && end_s > begin_s &&
         larger.seconds() > 10.0 * smaller.seconds();
}

double interval_s(const StampSpan& span) { return span.seconds() / static_cast<double>(span.count - 1); }

std::string of_no_use(const SampleFinding& finding) {
  if (finding.image == ImageTrouble::unreadable)
    return fmt::format(
        "none of {} images can be read: they must be JPEG or PNG, of camera.width_px x camera.height_px as rig.toml "
        "says",
        finding.sets.count);
  return fmt::format("none of {} images is of use: {}", finding.sets.count, to_string(finding.image));
}

/// The text of a translation and a rotation.
std::string distance(double metres, double radians) {
  return fmt::format("{:.3g} m and {:.2g} degrees", metres, rad_to_degrees(radians));
}

std::string jumps(const SampleFinding& finding) {
  return fmt::format(
      "odometry makes {} steps that no wheels make, the largest of {}: does a wheel's counter wrap, or do two programs "
      "send it? azimuth import unwraps tables and bags of wheels",
      finding.jumps, distance(finding.largest_jump.step_m, finding.largest_jump.step_rad));
}

std::string contradicted(const RigFinding& rig) {
  std::string values;
  const auto add = [&](const char* key, const std::optional<RigFinding::Value>& value) {
    if (!value) return;
    values += fmt::format("{}{} = {:.4f} +- {:.4f}", values.empty() ? "" : ", ", key, value->found, value->sigma);
  };
  add("camera.yaw_offset_rad", rig.yaw_offset_rad);
  add("odometry.scale_turn", rig.scale_turn);
  add("odometry.drift_rad_per_m", rig.drift_rad_per_m);
  add("odometry.lag_s", rig.lag_s);
  add("camera.position_m[0]", rig.camera_ahead_m);
  add("camera.position_m[1]", rig.camera_left_m);
  add("camera.roll_rad", rig.roll_rad);
  add("camera.pitch_rad", rig.pitch_rad);
  return fmt::format(
      "the drive contradicts the rig, and is believed: {} would fit; azimuth check tells whether that is the cause, "
      "azimuth calibrate finds it",
      values);
}

std::string scatter(const SampleFinding& finding) {
  return fmt::format(
      "bearings scatter {:.1f} times as much as camera.sigma_bearing_rad says, and are taken for that: {:.2g} would "
      "fit; "
      "is the camera another one, are names wrong, do landmarks move?",
      finding.rig.bearing_noise, finding.rig.bearing_noise * finding.sigma_bearing_rad);
}

std::string odometry_scatter(const SampleFinding& finding) {
  const double ratio = finding.rig.odometry_noise;
  return fmt::format(
      "odometry errs {:.1f} times as much as its odometry.lambda_... say, and is taken for that: {:.2g} times those "
      "would fit; do wheels slip, or is the odometer another one? azimuth calibrate odometry finds it",
      ratio, ratio * ratio);
}

}  // namespace

std::string apart_sentence(const StampSpan& odometry, const StampSpan& other, std::string_view what) {
  const std::string times = fmt::format("(odometry {}, {} {})", span(odometry), what, span(other));
  const auto in_unit = [&](std::string_view which, const StampUnit& unit) {
    return fmt::format(
        "{} stamps seem to be in {} {}: t_s is in seconds, utime in microseconds; azimuth import takes t_s=COLUMN[{}]",
        which, unit.name, times, unit.short_name);
  };
  for (const StampUnit& unit : kStampUnits) {
    if (are_alike(other, odometry, unit.per_s)) return in_unit(std::string(what) + "'", unit);
    if (are_alike(odometry, other, unit.per_s)) return in_unit("odometry's", unit);
  }
  return fmt::format(
      "{} are not of the odometry's time {}: are the stamps of two clocks, or in two units? t_s is in seconds, utime "
      "in "
      "microseconds",
      what, times);
}

std::string restart_sentence(std::span<const OdometryReading> readings) {
  std::size_t count = 0, first = 0, farthest = 0;
  double farthest_m = -1.0;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    if (readings[i].origin == readings[i - 1].origin) continue;
    if (count++ == 0) first = i;
    const double step_m = (readings[i].T_odom_body.position() - readings[i - 1].T_odom_body.position()).norm();
    if (step_m > farthest_m) farthest = i;
    farthest_m = std::max(farthest_m, step_m);
  }
  if (count == 0) return "";
  const OdometryReading &from = readings[farthest - 1], &to = readings[farthest];
  const double turn_rad = std::abs(wrap(to.T_odom_body.heading_rad - from.T_odom_body.heading_rad));
  const std::string known = to.sigma_gap_m > 0.0 || to.sigma_gap_rad > 0.0
                                ? ", and the way meanwhile is known to " + distance(to.sigma_gap_m, to.sigma_gap_rad)
                                : "";
  return fmt::format(
      "odometry begins anew {}{:.1f} s after its first reading, {}{} from where it was: it goes on from there{}",
      count > 1 ? fmt::format("{} times, first ", count) : "",
      to_seconds(readings[first].stamp - readings.front().stamp), count > 1 ? "at most " : "",
      distance(farthest_m, turn_rad), known);
}

std::string sentence(const SampleFinding& finding) {
  switch (finding.trouble) {
    case SampleTrouble::none:
      return "";
    case SampleTrouble::odometry_too_quick:
      return fmt::format(
          "odometry drives at {:.0f} m/s and turns at {:.0f} rad/s: are its stamps in another unit? t_s is in seconds, "
          "utime in microseconds",
          finding.fastest_m_s, finding.fastest_rad_s);
    case SampleTrouble::odometry_too_fast:
      return fmt::format("odometry drives at {:.0f} m/s: is it in millimetres? x_m and y_m are in metres",
                         finding.fastest_m_s);
    case SampleTrouble::odometry_heading_in_degrees:
      return fmt::format(
          "odometry turns at {:.0f} rad/s, and not as it drives: is its heading in degrees? heading_rad is in radians",
          finding.fastest_rad_s);
    case SampleTrouble::odometry_jumps:
      return jumps(finding);
    case SampleTrouble::bearings_in_degrees:
      return fmt::format(
          "bearings reach an angle of {:.0f}: are they in degrees? azimuth_rad and elevation_rad are in radians",
          finding.largest_angle_rad);
    case SampleTrouble::no_odometry:
      return "there are bearings but no odometry: is the odometer (daemon.live.odometer) running?";
    case SampleTrouble::one_reading:
      return "there is only one odometry reading: motion takes two at least, in odometry.csv or on AZIMUTH_ODOM";
    case SampleTrouble::apart_in_time:
      return apart_sentence(finding.odometry, finding.sets, "bearings");
    case SampleTrouble::odometry_too_rare:
      return fmt::format(
          "odometry readings are {:.3g} s apart, more than stage.wait_for_odometry_s = {:g}: are stamps in "
          "milliseconds? t_s is in seconds, utime in microseconds",
          interval_s(finding.odometry), finding.wait_limit_s);
    case SampleTrouble::odometry_missing:
      return fmt::format(
          "{} of {} bearing sets have no odometry within stage.wait_for_odometry_s = {:g}: does the odometer pause, or "
          "lag behind?",
          finding.without_odometry, finding.sets.count, finding.wait_limit_s);
    case SampleTrouble::images_of_no_use:
      return of_no_use(finding);
    case SampleTrouble::nothing_seen:
      return fmt::format(
          "not one bearing in {} images: do front_end and the landmarks of the configuration fit what there is to see?",
          finding.sets.count);
    case SampleTrouble::no_identities:
      return fmt::format(
          "camera.identities is true in rig.toml, but none of {} bearings has a landmark_id, so all are ignored: set "
          "it to false",
          finding.bearings);
    case SampleTrouble::names_repeated:
      return fmt::format(
          "in {} of {} images a landmark is seen more than once: do rows of several images share one t_s, in whole "
          "seconds perhaps? rows of one t_s are of one image",
          finding.repeating, finding.sets.count);
    case SampleTrouble::rig_contradicted:
      return contradicted(finding.rig);
    case SampleTrouble::bearings_scatter:
      return scatter(finding);
    case SampleTrouble::odometry_scatters:
      return odometry_scatter(finding);
  }
  return "";
}

}  // namespace azimuth
