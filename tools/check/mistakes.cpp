#include "tools/check/mistakes.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

// "key = value" texts for rig.toml.

std::string hand_key(const Rig& said, const RigGuess& /*found*/) {
  return direction_text(rig_saying({.rig = said, .mirrored = true}, said));
}

std::string wheels_key(const Rig& said, const RigGuess& /*found*/) {
  return fmt::format("odometry.wheels_swapped = {}", !said.odometry.wheels_swapped);
}

std::string heading_key(const Rig& said, const RigGuess& found) { return heading_text(rig_saying(found, said)); }

std::string turn_key(const Rig& /*said*/, const RigGuess& found) {
  return fmt::format("odometry.scale_turn = {:.4f}", found.rig.odometry.scale_turn);
}

std::string drift_key(const Rig& /*said*/, const RigGuess& found) {
  return fmt::format("odometry.drift_rad_per_m = {:.4f}", found.rig.odometry.drift_rad_per_m);
}

std::string lag_key(const Rig& /*said*/, const RigGuess& found) {
  return fmt::format("odometry.lag_s = {:.3f}", found.rig.odometry.lag_s);
}

std::string clock_key(const Rig& said, const RigGuess& found) {
  return fmt::format("odometry.clock_drift = {:.6f}, with {}", found.rig.odometry.clock_drift, lag_key(said, found));
}

std::string jump_key(const Rig& /*said*/, const RigGuess& found) {
  return fmt::format("a jump of {:.2f} s", found.jump.by_s);
}

std::string mount_key(const Rig& /*said*/, const RigGuess& found) {
  const Eigen::Vector2d p_m = mount_of(found.rig);
  return fmt::format("camera.position_m = [{:.3f}, {:.3f}]", p_m.x(), p_m.y());
}

std::string centre_key(const Rig& said, const RigGuess& found) {
  const Eigen::Vector2d off = in_image(found.centre_px, said);
  if (!said.camera.image.centre_px)
    return fmt::format("camera.centre_px, which is {:.1f} px further along u and {:.1f} px along v", off.x(), off.y());
  const PixelPoint& centre = *said.camera.image.centre_px;
  return fmt::format("camera.centre_px = [{:.1f}, {:.1f}]", centre[0] + off.x(), centre[1] + off.y());
}

// Descriptions of each mistake.

std::string hand_wrong(const Rig& /*said*/, const RigGuess& /*found*/) {
  return "azimuths grow the other way than the rig says";
}

std::string wheels_wrong(const Rig& /*said*/, const RigGuess& /*found*/) {
  return "the odometer turns right where the robot turns left; are the wheels swapped?";
}

std::string heading_wrong(const Rig& said, const RigGuess& found) {
  const double off_rad = wrap(found.rig.camera.yaw_offset_rad - said.camera.yaw_offset_rad);
  return fmt::format("the camera's heading is off by {:.1f} degrees", rad_to_degrees(off_rad));
}

std::string turn_wrong(const Rig& said, const RigGuess& found) {
  return fmt::format("the robot turns {:.3f} times what the rig makes of its odometry",
                     found.rig.odometry.scale_turn / said.odometry.scale_turn);
}

std::string drift_wrong(const Rig& said, const RigGuess& found) {
  return fmt::format("the heading drifts by {:.3f} rad for each metre more than the rig says",
                     found.rig.odometry.drift_rad_per_m - said.odometry.drift_rad_per_m);
}

std::string lag_wrong(const Rig& said, const RigGuess& found) {
  const double by_s = found.rig.odometry.lag_s - said.odometry.lag_s;
  return fmt::format("odometry is {:.2f} s {} against the bearings", std::abs(by_s), by_s > 0.0 ? "early" : "late");
}

std::string clock_wrong(const Rig& said, const RigGuess& found) {
  return fmt::format("the clocks of odometry and bearings drift apart, by {:.2f} s an hour",
                     3600.0 * (found.rig.odometry.clock_drift - said.odometry.clock_drift));
}

std::string jump_wrong(const Rig& /*said*/, const RigGuess& found) {
  return fmt::format(
      "from {:.1f} s on bearings are {:.2f} s {}, and were not before: did the camera's clock jump, or the camera "
      "start anew? Let one clock stamp both, or record anew; no key mends it",
      found.jump.after_s, std::abs(found.jump.by_s), found.jump.by_s > 0.0 ? "later" : "earlier");
}

std::string mount_wrong(const Rig& said, const RigGuess& found) {
  const Eigen::Vector2d off_m = mount_of(found.rig) - mount_of(said);
  return fmt::format(
      "the camera stands {:.2f} m further {} and {:.2f} m further to the {} on the robot than the rig says",
      std::abs(off_m.x()), off_m.x() < 0.0 ? "back" : "ahead", std::abs(off_m.y()), off_m.y() < 0.0 ? "right" : "left");
}

std::string centre_wrong(const Rig& /*said*/, const RigGuess& found) {
  return fmt::format("the image's centre is {:.0f} px off", found.centre_px.norm());
}

// Differences between found values and present ones.

double sigma_of(const DriveSolution& found, int which) {
  return std::sqrt(std::max(0.0, found.covariance(which, which)));
}

/// Length of the offset, and its standard deviation along the offset's direction.
Off off_in_plane(const Eigen::Vector2d& by, const Eigen::Matrix2d& P) {
  const double length = by.norm();
  const Eigen::Vector2d along = length > 0.0 ? Eigen::Vector2d(by / length) : Eigen::Vector2d::UnitX();
  return {length, std::sqrt(std::max(0.0, along.dot(P * along)))};
}

Off heading_off(const DriveSolution& found, const DriveSolution& now, double /*drive_s*/) {
  return {wrap(found.guess.rig.camera.yaw_offset_rad - now.guess.rig.camera.yaw_offset_rad),
          sigma_of(found, calibration::yaw)};
}

Off turn_off(const DriveSolution& found, const DriveSolution& now, double /*drive_s*/) {
  const double scale = now.guess.rig.odometry.scale_turn;
  return {found.guess.rig.odometry.scale_turn / scale - 1.0, sigma_of(found, calibration::scale_turn) / scale};
}

Off drift_off(const DriveSolution& found, const DriveSolution& now, double /*drive_s*/) {
  return {found.guess.rig.odometry.drift_rad_per_m - now.guess.rig.odometry.drift_rad_per_m,
          sigma_of(found, calibration::drift)};
}

Off lag_off(const DriveSolution& found, const DriveSolution& now, double /*drive_s*/) {
  return {found.guess.rig.odometry.lag_s - now.guess.rig.odometry.lag_s, sigma_of(found, calibration::lag)};
}

Off clock_off(const DriveSolution& found, const DriveSolution& now, double drive_s) {
  return {drive_s * (found.guess.rig.odometry.clock_drift - now.guess.rig.odometry.clock_drift),
          drive_s * sigma_of(found, calibration::lag_growth)};
}

Off jump_off(const DriveSolution& found, const DriveSolution& /*now*/, double /*drive_s*/) {
  return {found.guess.jump.by_s, sigma_of(found, calibration::lag_growth)};
}

Off mount_off(const DriveSolution& found, const DriveSolution& now, double /*drive_s*/) {
  return off_in_plane(mount_of(found.guess.rig) - mount_of(now.guess.rig),
                      found.covariance.block<2, 2>(calibration::lag, calibration::lag));
}

Off centre_off(const DriveSolution& found, const DriveSolution& now, double /*drive_s*/) {
  return off_in_plane(found.guess.centre_px - now.guess.centre_px,
                      found.covariance.block<2, 2>(calibration::centre_x, calibration::centre_x));
}

constexpr std::string_view kTurnBothWays = "drive on, with corners to the left and to the right";
constexpr std::string_view kSpeeds = "drive on, with quick turns both ways and stops between them";

const std::array<MistakeRow, kMistakes> kRows{{
    {Mistake::leaps, "leaps", 0.0, 1.0, "m", "", nullptr, nullptr, nullptr},
    {Mistake::senders, "senders", 0.0, 1.0, "m", "", nullptr, nullptr, nullptr},
    {Mistake::hand, "direction", 0.0, 1.0, "", "drive on, and turn", hand_key, hand_wrong, nullptr},
    {Mistake::wheels, "wheels", 0.0, 1.0, "", "drive on, and turn", wheels_key, wheels_wrong, nullptr},
    {Mistake::heading, "heading", degrees_to_rad(5.0), rad_to_degrees(1.0), "degrees",
     "drive some metres straight on past landmarks at either side", heading_key, heading_wrong, heading_off},
    {Mistake::turn, "turn", 0.05, 100.0, "%", kTurnBothWays, turn_key, turn_wrong, turn_off},
    {Mistake::drift, "drift", 0.03, 1.0, "rad/m", "drive on, some of it straight, and come back to where you began",
     drift_key, drift_wrong, drift_off},
    {Mistake::lag, "lag", 0.1, 1.0, "s", kSpeeds, lag_key, lag_wrong, lag_off},
    {Mistake::clock, "clock", 0.1, 1.0, "s over the drive", kSpeeds, clock_key, clock_wrong, clock_off},
    {Mistake::jump, "jump", 0.1, 1.0, "s", kSpeeds, jump_key, jump_wrong, jump_off},
    {Mistake::mount, "mount", 0.1, 1.0, "m", "turn on the spot both ways, near landmarks", mount_key, mount_wrong,
     mount_off},
    {Mistake::centre, "centre", 5.0, 1.0, "px",
     "bearings made of images by azimuth have radius_px; let landmarks be seen all round", centre_key, centre_wrong,
     centre_off},
    {Mistake::tilt, "tilt", degrees_to_rad(2.0), rad_to_degrees(1.0), "degrees",
     "drive near things that are much higher or lower than the camera, with images of a camera whose model the rig has",
     nullptr, nullptr, nullptr},
    {Mistake::creep, "creep", 0.0, 1.0, "", "let the robot stand for ten seconds in sight of landmarks", nullptr,
     nullptr, nullptr},
    {Mistake::distance, "distance", 0.05, 100.0, "%",
     "a truth.csv, or a landmarks.csv with the landmarks' names and measured places, beside the run", nullptr, nullptr,
     nullptr},
}};

}  // namespace

const MistakeRow& row_of(Mistake mistake) { return kRows[static_cast<std::size_t>(mistake)]; }

}  // namespace azimuth
