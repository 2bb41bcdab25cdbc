#include "tools/check/sentences.hpp"

#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

std::string hand_key(const Rig& said) {
  if (sees_images(said)) return fmt::format("camera.azimuth_direction = {}", -said.camera.image.azimuth_direction);
  return fmt::format("camera.azimuths_clockwise = {}", !said.camera.azimuths_clockwise);
}

std::string wheels_key(const Rig& said) {
  return fmt::format("odometry.wheels_swapped = {}", !said.odometry.wheels_swapped);
}

std::string heading_key(const Rig& said, const RigGuess& found) {
  const CameraRig camera = rig_saying(found, said).camera;
  if (sees_images(said)) return fmt::format("camera.azimuth_offset_rad = {:.4f}", camera.image.azimuth_offset_rad);
  return fmt::format("camera.yaw_offset_rad = {:.4f}", camera.yaw_offset_rad);
}

std::string centre_key(const Rig& said, const RigGuess& found) {
  const Eigen::Vector2d off = in_image(found.centre_px, said);
  if (!said.camera.image.centre_px)
    return fmt::format("camera.centre_px, which is {:.1f} px further along u and {:.1f} px along v", off.x(), off.y());
  const PixelPoint& centre = *said.camera.image.centre_px;
  return fmt::format("camera.centre_px = [{:.1f}, {:.1f}]", centre[0] + off.x(), centre[1] + off.y());
}

/// "key = value" of a number of the odometry.
std::string odometry_key(Mistake mistake, const OdometryRig& odometry) {
  switch (mistake) {
    case Mistake::turn:
      return fmt::format("odometry.scale_turn = {:.4f}", odometry.scale_turn);
    case Mistake::drift:
      return fmt::format("odometry.drift_rad_per_m = {:.4f}", odometry.drift_rad_per_m);
    case Mistake::lag:
      return fmt::format("odometry.lag_s = {:.3f}", odometry.lag_s);
    case Mistake::clock:
      return fmt::format("odometry.clock_drift = {:.6f}, with odometry.lag_s = {:.3f}", odometry.clock_drift,
                         odometry.lag_s);
    default:
      return {};
  }
}

/// In the unit that a person thinks in.
std::string amount(Mistake mistake, double value) {
  switch (mistake) {
    case Mistake::heading:
      return fmt::format("{:.2g} degrees", rad_to_degrees(value));
    case Mistake::turn:
    case Mistake::distance:
      return fmt::format("{:.2g} %", 100.0 * value);
    case Mistake::drift:
      return fmt::format("{:.2g} rad/m", value);
    case Mistake::lag:
      return fmt::format("{:.2g} s", value);
    case Mistake::clock:
      return fmt::format("{:.2g} s over the drive", value);
    case Mistake::centre:
      return fmt::format("{:.2g} px", value);
    default:
      return {};
  }
}

}  // namespace

std::string sentence_wrong(Mistake mistake, const Rig& said, const RigGuess& found,
                           const std::optional<RigGuess>& rival) {
  if (rival)
    return fmt::format(
        "bearings and turns go opposite ways: {} if azimuths grow clockwise, or {} if the wheels are swapped. Which of "
        "the two, neither bearings nor odometry tell: push the robot round to the left, and heading_rad must grow",
        hand_key(said), wheels_key(said));
  switch (mistake) {
    case Mistake::hand:
      return fmt::format("azimuths grow the other way than the rig says: {}", hand_key(said));
    case Mistake::wheels:
      return fmt::format("the odometer turns right where the robot turns left; are the wheels swapped? {}",
                         wheels_key(said));
    case Mistake::heading: {
      const double off_rad = wrap(found.rig.camera.yaw_offset_rad - said.camera.yaw_offset_rad);
      return fmt::format("the camera's heading is off by {:.1f} degrees: {}", rad_to_degrees(off_rad),
                         heading_key(said, found));
    }
    case Mistake::turn:
      return fmt::format("the robot turns {:.3f} times what the rig makes of its odometry: {}",
                         found.rig.odometry.scale_turn / said.odometry.scale_turn,
                         odometry_key(mistake, found.rig.odometry));
    case Mistake::drift:
      return fmt::format("the heading drifts by {:.3f} rad for each metre more than the rig says: {}",
                         found.rig.odometry.drift_rad_per_m - said.odometry.drift_rad_per_m,
                         odometry_key(mistake, found.rig.odometry));
    case Mistake::lag:
      return fmt::format(
          "odometry is {:.2f} s {} against the bearings: {}", std::abs(found.rig.odometry.lag_s - said.odometry.lag_s),
          found.rig.odometry.lag_s > said.odometry.lag_s ? "early" : "late", odometry_key(mistake, found.rig.odometry));
    case Mistake::clock:
      return fmt::format("the clocks of odometry and bearings drift apart, by {:.2f} s an hour: {}",
                         3600.0 * (found.rig.odometry.clock_drift - said.odometry.clock_drift),
                         odometry_key(mistake, found.rig.odometry));
    case Mistake::centre:
      return fmt::format("the image's centre is {:.0f} px off: {}", found.centre_px.norm(), centre_key(said, found));
    case Mistake::distance:
      break;
  }
  return {};
}

std::string sentence_either(Mistake mistake) {
  return fmt::format("this or the other one: see {}",
                     to_string(mistake == Mistake::hand ? Mistake::wheels : Mistake::hand));
}

std::string sentence_fits(Mistake mistake, const Rig& said, const RigGuess& found, double sigma) {
  switch (mistake) {
    case Mistake::hand:
    case Mistake::wheels:
      return "fits: the other way round does not";
    case Mistake::heading:
      return fmt::format("fits: {} would fit best, +- {}", heading_key(said, found), amount(mistake, sigma));
    case Mistake::centre:
      return fmt::format("fits: {} would fit best, +- {}", centre_key(said, found), amount(mistake, sigma));
    default:
      return fmt::format("fits: {} would fit best, +- {}", odometry_key(mistake, found.rig.odometry),
                         amount(mistake, sigma));
  }
}

std::string sentence_cannot_tell(Mistake mistake, double sigma) {
  switch (mistake) {
    case Mistake::hand:
    case Mistake::wheels:
      return "cannot tell: the drive is as likely either way; drive on, and turn";
    case Mistake::distance:
      if (!(sigma > 0.0))
        return "cannot tell: bearings know no lengths, and the run has neither truth nor surveyed landmarks";
      break;
    case Mistake::centre:
      if (!(sigma > 0.0)) return "cannot tell: bearings do not say how far from the image's centre they were seen";
      break;
    default:
      break;
  }
  if (!(sigma > 0.0)) return "cannot tell from this drive";
  return fmt::format("cannot tell: known to +- {} only; a longer drive with more turns tells", amount(mistake, sigma));
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
