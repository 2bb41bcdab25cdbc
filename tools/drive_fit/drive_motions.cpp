#include "tools/drive_fit/drive_motions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/estimator/mounted_estimator.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/geometry/index.hpp"
#include "slam/smoother/factors.hpp"

namespace azimuth {
namespace {

// Step of the central differences by lag. It is about the interval between readings, so that interpolation within one
// interval does not dominate the derivative.
constexpr double kAround_s = 0.1;

std::vector<OdometryTrack::Step> steps_at(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                                          std::span<const Stamp> stamps) {
  OdometryTrack track(rig);
  std::size_t read = 0;
  std::vector<OdometryTrack::Step> steps;
  for (const Stamp stamp : stamps) {
    while (read < odometry.size() && (track.empty() || track.newest() < stamp)) track.add(odometry[read++]);
    steps.push_back(track.advance_to(stamp));
  }
  return steps;
}

OdometryRig later_by(OdometryRig rig, double lag_s) {
  rig.lag_s += lag_s;
  return rig;
}

/// The end pose relative to the start pose, as (x, y, heading).
Eigen::Vector3d seen_from(const Pose2& start, const Pose2& end) { return (inverse(start) * end).vector(); }

/// A robot that drives straight is steered: each heading error is followed by a small correcting turn. A fit that takes
/// turns as independent of the errors reads these corrections as a scale below 1 and a lag. Only large, intended
/// changes therefore determine a number: the largest ones that make up this share of the sum of all squares.
constexpr double kWanted = 0.9;

/// The smallest size among the intended changes.
double least_wanted(std::vector<double> sizes) {
  std::ranges::sort(sizes, std::ranges::greater());
  double all = 0.0, counted = 0.0;
  for (const double size : sizes) all += size * size;
  for (const double size : sizes)
    if ((counted += size * size) >= kWanted * all) return size;
  return 0.0;
}

double turn_by_lag(const DriveMotion& motion) { return std::abs(motion.by_lag(2, 0)); }
double turn_by_scale(const DriveMotion& motion) { return std::abs(motion.motion.by_scales(2, 1)); }

/// Zeroes the derivatives of all motions below the limit. `of_turns`: also those by the scale of turns.
void keep_wanted(bool of_turns, std::vector<DriveMotion>& motions) {
  std::vector<double> by_lag, by_scale;
  for (const DriveMotion& motion : motions) {
    by_lag.push_back(turn_by_lag(motion));
    by_scale.push_back(turn_by_scale(motion));
  }
  const double least_by_lag = least_wanted(std::move(by_lag)), least_by_scale = least_wanted(std::move(by_scale));
  for (DriveMotion& motion : motions) {
    if (turn_by_lag(motion) < least_by_lag) motion.by_lag.setZero();
    if (of_turns && turn_by_scale(motion) < least_by_scale) motion.motion.by_scales.col(1).setZero();
  }
}

/// Stamps of images, corrected for the jump of the camera's clock.
std::vector<Stamp> without_jump(std::span<const Stamp> stamps, const CameraJump& jump) {
  std::vector<Stamp> result(stamps.begin(), stamps.end());
  for (Stamp& stamp : result) stamp = jump.without(stamp);
  return result;
}

void move_to_mount(const Eigen::Vector2d& mount_m, DriveMotion& each) {
  each.by_lag = point_pose_by_body(mount_m, each.motion.T_start_end.heading_rad) * each.by_lag;
  each.motion = point_motion(mount_m, each.motion);
}

Eigen::Vector3d slope(const Eigen::Vector3d& above, const Eigen::Vector3d& below) {
  Eigen::Vector3d difference = above - below;
  difference.z() = wrap(difference.z());
  return difference / (2.0 * kAround_s);
}

/// Seconds since the first reading: the factor of a lag that grows.
std::vector<double> growing(std::span<const Stamp> stamps, Stamp first) {
  std::vector<double> seconds;
  for (const Stamp stamp : stamps) seconds.push_back(to_seconds(stamp - first));
  return seconds;
}

/// The factor of a clock jump: 0 before its instant, 1 from then on.
std::vector<double> jumping(std::span<const Stamp> stamps, const CameraJump& jump) {
  std::vector<double> after;
  for (const Stamp stamp : stamps) after.push_back(stamp >= jump.at ? 1.0 : 0.0);
  return after;
}

/// `second`: for each stamp, the factor with which the graph's second number adds to the lag.
std::vector<DriveMotion> motions_with(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                                      std::span<const Stamp> stamps, std::span<const double> second,
                                      bool large_turns_alone) {
  const auto here = steps_at(odometry, rig, stamps);
  const auto later = steps_at(odometry, later_by(rig, kAround_s), stamps);
  const auto sooner = steps_at(odometry, later_by(rig, -kAround_s), stamps);
  std::vector<DriveMotion> motions;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    DriveMotion& motion = motions.emplace_back(DriveMotion{here[i].motion});
    if (i == 0) continue;
    const Pose2 &start = here[i - 1].T_odom_body, &end = here[i].T_odom_body;
    const Eigen::Vector3d by_start = slope(seen_from(later[i - 1].T_odom_body, end),
                                           seen_from(sooner[i - 1].T_odom_body, end)),
                          by_end =
                              slope(seen_from(start, later[i].T_odom_body), seen_from(start, sooner[i].T_odom_body));
    motion.by_lag << by_start + by_end, second[i - 1] * by_start + second[i] * by_end;
  }
  keep_wanted(large_turns_alone, motions);
  return motions;
}

}  // namespace

std::vector<DriveMotion> motions_between(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                                         std::span<const Stamp> stamps, bool large_turns_alone) {
  return motions_with(odometry, rig, stamps, growing(stamps, odometry.front().stamp), large_turns_alone);
}

std::vector<DriveMotion> motions_between(std::span<const OdometryReading> odometry, const RigGuess& guess,
                                         std::span<const Stamp> stamps) {
  const Stamp first = odometry.front().stamp;
  const std::vector<double> second =
      guess.numbers == MotionNumbers::jump ? jumping(stamps, guess.jump) : growing(stamps, first);
  std::vector<DriveMotion> motions =
      motions_with(odometry, guess.rig.odometry, without_jump(stamps, guess.jump), second, guess.large_turns_alone);
  for (std::size_t i = 1; i < motions.size(); ++i) {
    DriveMotion& each = motions[i];
    move_to_mount(mount_of(guess.rig), each);
    if (guess.numbers == MotionNumbers::mount)
      each.by_lag << rotation(each.motion.T_start_end.heading_rad) - Eigen::Matrix2d::Identity(),
          Eigen::RowVector2d::Zero();
  }
  return motions;
}

std::vector<Pose2> camera_at(std::span<const OdometryReading> odometry, const RigGuess& guess,
                             std::span<const Stamp> stamps) {
  std::vector<Pose2> poses = odometry_at(odometry, guess.rig.odometry, without_jump(stamps, guess.jump));
  for (Pose2& pose : poses) pose = point_pose(mount_of(guess.rig), pose);
  return poses;
}

std::vector<Pose2> odometry_at(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                               std::span<const Stamp> stamps) {
  std::vector<Pose2> poses;
  for (const OdometryTrack::Step& step : steps_at(odometry, rig, stamps)) poses.push_back(step.T_odom_body);
  return poses;
}

}  // namespace azimuth
