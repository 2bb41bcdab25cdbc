#include "settings/sample_sentence.hpp"

#include <fmt/format.h>

namespace azimuth {
namespace {

std::string span(const StampSpan& span) {
  return fmt::format("{:.0f} to {:.0f} s", to_seconds(span.first), to_seconds(span.last));
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

}  // namespace

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
    case SampleTrouble::bearings_in_degrees:
      return fmt::format(
          "bearings reach an angle of {:.0f}: are they in degrees? azimuth_rad and elevation_rad are in radians",
          finding.largest_angle_rad);
    case SampleTrouble::no_odometry:
      return "there are bearings but no odometry: is the odometer (daemon.live.odometer) running?";
    case SampleTrouble::one_reading:
      return "there is only one odometry reading: motion takes two at least, in odometry.csv or on AZIMUTH_ODOM";
    case SampleTrouble::apart_in_time:
      return fmt::format(
          "bearings are not of the odometry's time (odometry {}, bearings {}): are the stamps of two clocks, or in two "
          "units? t_s is in seconds, utime in microseconds",
          span(finding.odometry), span(finding.sets));
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
  }
  return "";
}

}  // namespace azimuth
