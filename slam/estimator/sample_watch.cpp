#include "slam/estimator/sample_watch.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// Number of samples required for a verdict while more are to come.
constexpr std::uint64_t kSets = 10, kBearings = 20, kAngles = 3;
/// Bearings and odometry must overlap in at least one part in kLeastSpare of the bearings' time.
constexpr int kLeastSpare = 10;
constexpr double kScatters = 1.5;  // times the rig's standard deviation

SampleTrouble trouble_of(OdometryDoubt doubt) {
  switch (doubt) {
    case OdometryDoubt::none:
      return SampleTrouble::none;
    case OdometryDoubt::too_quick:
      return SampleTrouble::odometry_too_quick;
    case OdometryDoubt::too_fast:
      return SampleTrouble::odometry_too_fast;
    case OdometryDoubt::heading_in_degrees:
      return SampleTrouble::odometry_heading_in_degrees;
    case OdometryDoubt::jumps:
      return SampleTrouble::odometry_jumps;
  }
  return SampleTrouble::none;
}

/// Looks at the first kMost bearings only: comparing all of a thousand would take too long.
bool repeats_a_name(const BearingSet& set) {
  constexpr std::size_t kMost = 64;
  const std::size_t count = std::min(set.bearings.size(), kMost);
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t j = 0; j < i && set.bearings[i].identity != kUnknownIdentity; ++j)
      if (set.bearings[i].identity == set.bearings[j].identity) return true;
  return false;
}

}  // namespace

std::string_view to_string(SampleTrouble trouble) {
  switch (trouble) {
    case SampleTrouble::none:
      return "";
    case SampleTrouble::odometry_too_quick:
      return "odometry's stamps seem to be in another unit";
    case SampleTrouble::odometry_too_fast:
      return "odometry seems to be in millimetres";
    case SampleTrouble::odometry_heading_in_degrees:
      return "odometry's heading seems to be in degrees";
    case SampleTrouble::odometry_jumps:
      return "odometry makes steps that no wheels make";
    case SampleTrouble::bearings_in_degrees:
      return "bearings seem to be in degrees";
    case SampleTrouble::no_odometry:
      return "there is no odometry";
    case SampleTrouble::one_reading:
      return "there is only one odometry reading";
    case SampleTrouble::apart_in_time:
      return "bearings and odometry are of different times";
    case SampleTrouble::odometry_too_rare:
      return "odometry readings are too far apart";
    case SampleTrouble::odometry_missing:
      return "most bearings have no odometry";
    case SampleTrouble::images_of_no_use:
      return "not one image is of use";
    case SampleTrouble::nothing_seen:
      return "not one bearing was seen";
    case SampleTrouble::names_repeated:
      return "images show a landmark more than once";
    case SampleTrouble::no_identities:
      return "bearings carry no identities, which the rig promises";
    case SampleTrouble::rig_contradicted:
      return "the drive contradicts the rig";
    case SampleTrouble::bearings_scatter:
      return "bearings scatter far more than the rig says";
    case SampleTrouble::odometry_scatters:
      return "odometry errs far more than the rig says";
  }
  return "?";
}

void StampSpan::add(Stamp stamp) {
  if (count++ == 0) first = stamp;
  last = stamp;
}

bool is_beyond_radians(const Bearing& bearing) {
  const auto is_beyond = [](double angle_rad, double limit_rad) {
    return std::isfinite(angle_rad) && std::abs(angle_rad) > limit_rad;
  };
  return is_beyond(bearing.azimuth_rad, 2.0 * kPi) || is_beyond(bearing.elevation_rad, 0.5 * kPi);
}

SampleWatch::SampleWatch(const Rig& rig, Duration wait_limit)
    : promises_identities_(rig.camera.identities), wait_limit_(wait_limit), odometry_(rig.odometry) {
  finding_.wait_limit_s = to_seconds(wait_limit);
  finding_.sigma_bearing_rad = rig.camera.sigma_bearing_rad;
}

void SampleWatch::add(const OdometryReading& reading) {
  finding_.odometry.add(reading.stamp);
  odometry_.add(reading);
}

void SampleWatch::add(const BearingSet& set) {
  finding_.sets.add(set.stamp);
  finding_.image = set.trouble;
  troubled_ += set.trouble != ImageTrouble::none ? 1 : 0;
  unreadable_ += set.trouble == ImageTrouble::unreadable ? 1 : 0;
  finding_.bearings += set.bearings.size();
  finding_.repeating += repeats_a_name(set) ? 1 : 0;
  for (const Bearing& bearing : set.bearings) {
    named_ += bearing.identity != kUnknownIdentity ? 1 : 0;
    if (!is_beyond_radians(bearing)) continue;
    ++beyond_;
    finding_.largest_angle_rad = std::max(finding_.largest_angle_rad, std::abs(bearing.azimuth_rad));
  }
}

SampleTrouble SampleWatch::trouble() const {
  if (const SampleTrouble found = odometry_trouble(); found != SampleTrouble::none) return found;
  if (enough(beyond_, kAngles)) return SampleTrouble::bearings_in_degrees;
  if (const SampleTrouble found = time_trouble(); found != SampleTrouble::none) return found;
  if (const SampleTrouble found = bearing_trouble(); found != SampleTrouble::none) return found;
  return rig_trouble();
}

SampleTrouble SampleWatch::impossible() const {
  const SampleTrouble odometry = odometry_trouble();
  if (odometry != SampleTrouble::none && odometry != SampleTrouble::odometry_jumps) return odometry;
  return enough(beyond_, kAngles) ? SampleTrouble::bearings_in_degrees : SampleTrouble::none;
}

SampleFinding SampleWatch::finding() const {
  SampleFinding finding = finding_;
  finding.trouble = trouble();
  finding.fastest_m_s = odometry_.fastest_m_s();
  finding.fastest_rad_s = odometry_.fastest_rad_s();
  finding.jumps = odometry_.jumps();
  finding.largest_jump = odometry_.largest_jump();
  return finding;
}

SampleTrouble SampleWatch::odometry_trouble() const { return trouble_of(odometry_.doubt(finished_)); }

SampleTrouble SampleWatch::time_trouble() const {
  const StampSpan &odometry = finding_.odometry, &sets = finding_.sets;
  if (!enough(static_cast<std::uint64_t>(refused_.held()), kSets) || !refused_.mostly()) return SampleTrouble::none;
  if (odometry.count == 0) return SampleTrouble::no_odometry;
  if (odometry.count == 1) return SampleTrouble::one_reading;
  const Duration common = std::min(odometry.last, sets.last) - std::max(odometry.first, sets.first);
  if (kLeastSpare * common < sets.last - sets.first) return SampleTrouble::apart_in_time;
  const auto intervals = static_cast<std::int64_t>(odometry.count - 1);
  const bool too_rare = (odometry.last - odometry.first) / intervals > wait_limit_;
  return too_rare ? SampleTrouble::odometry_too_rare : SampleTrouble::odometry_missing;
}

/// A wrong value of the rig makes samples seem noisy too, so it is reported first.
SampleTrouble SampleWatch::rig_trouble() const {
  if (finding_.rig.contradicts()) return SampleTrouble::rig_contradicted;
  if (finding_.rig.bearing_noise > kScatters) return SampleTrouble::bearings_scatter;
  return finding_.rig.odometry_noise > kScatters ? SampleTrouble::odometry_scatters : SampleTrouble::none;
}

SampleTrouble SampleWatch::bearing_trouble() const {
  const std::uint64_t sets = finding_.sets.count;
  if (enough(unreadable_, kSets) && unreadable_ == sets) return SampleTrouble::images_of_no_use;
  if (promises_identities_ && named_ == 0 && enough(finding_.bearings, kBearings)) return SampleTrouble::no_identities;
  if (enough(finding_.repeating, kSets) && 2 * finding_.repeating > sets) return SampleTrouble::names_repeated;
  if (!finished_ || sets == 0) return SampleTrouble::none;  // a robot may stand in the dark for a while
  if (troubled_ == sets) return SampleTrouble::images_of_no_use;
  return finding_.bearings == 0 ? SampleTrouble::nothing_seen : SampleTrouble::none;
}

}  // namespace azimuth
