// Somebody carries the robot into a room that it has never seen, and later back home.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "settings/configured_estimator.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/encoder_robot.hpp"
#include "tools/evaluate/trajectory.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {
namespace {

constexpr int kDrives = 20;
constexpr double kAtHome_m = 0.3;

struct CarriedDrive {
  double until_said_s = INFINITY;   ///< from the first bearings next door until health is no longer `tracking`
  double until_found_s = INFINITY;  ///< from the first bearings at home until health is `tracking`
  /// Number of steps before the carrying with health other than `starting` or `tracking`.
  int said_before = 0;
  /// RMSE of the position over the steps with health `tracking`; `anees` covers the same steps
  double tracking_m = 0.0;
  double anees = 0.0, tracking = 0.0;
};

double anees_of(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  return error.dot(covariance.ldlt().solve(error)) / 3.0;
}

CarriedDrive driven_off(EncoderRobot robot, std::uint64_t seed) {
  robot.seed = seed;
  std::vector<Stamp> set_down;
  const Run run = driven(robot, &set_down);
  const Rig rig = rig_of(run);
  const ReplayResult result = replay(run, rig, configured_estimator(rig, {}), StageSettings{});
  std::vector<StampedPose> truth;
  for (const TruthPose& reading : run.truth) truth.push_back({reading.stamp, reading.T_world_body});
  const auto true_at = [&](Stamp stamp) { return *pose_at(truth, stamp); };
  const EstimateRecord& first = result.estimates.front();
  const Pose2 T_world_map = true_at(first.stamp) * inverse(first.T_map_body);

  CarriedDrive drive;
  double tracked = 0.0;
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const EstimateRecord& estimate = result.estimates[i];
    const Health health = result.healths[i].health;
    Eigen::Vector3d error = estimate.T_map_body.vector() - (inverse(T_world_map) * true_at(estimate.stamp)).vector();
    error.z() = wrap(error.z());
    if (health == Health::tracking) {
      ++tracked;
      drive.tracking_m += error.head<2>().squaredNorm();
      drive.anees += anees_of(error, estimate.covariance);
    }
    if (estimate.stamp < set_down[0])
      drive.said_before += health >= Health::degraded ? 1 : 0;
    else if (estimate.stamp < set_down[1] && health != Health::tracking)
      drive.until_said_s = std::min(drive.until_said_s, to_seconds(estimate.stamp - set_down[0]));
    else if (estimate.stamp >= set_down[1] && health == Health::tracking && error.head<2>().norm() < kAtHome_m)
      drive.until_found_s = std::min(drive.until_found_s, to_seconds(estimate.stamp - set_down[1]));
  }
  drive.tracking_m = std::sqrt(drive.tracking_m / tracked);
  drive.anees /= tracked;
  drive.tracking = tracked / static_cast<double>(result.estimates.size());
  return drive;
}

/// Least number of drives that must notice the carrying in time, relocalise in time, and have consistent covariances.
struct Fewest {
  int said = kDrives, found = kDrives - 1, honest = kDrives - 1;
  double worst_anees = 10.0;
};

void expect_found_out(const EncoderRobot& robot, const std::string& title, const Fewest& fewest = {}) {
  int said = 0, found = 0, silent_before = 0;
  int honest = 0;
  double worst_anees = 0.0, worst_m = 0.0;
  for (int seed = 1; seed <= kDrives; ++seed) {
    const CarriedDrive drive = driven_off(robot, static_cast<std::uint64_t>(seed));
    said += drive.until_said_s <= 3.0 ? 1 : 0;
    found += drive.until_found_s <= 5.0 ? 1 : 0;
    silent_before += drive.said_before == 0 ? 1 : 0;
    honest += drive.anees <= 6.0 ? 1 : 0;
    worst_anees = std::max(worst_anees, drive.anees);
    worst_m = std::max(worst_m, drive.tracking_m);
    fmt::print(
        "  {:2}: said after {:4.1f} s, found after {:4.1f} s, {:3.0f} % tracking, {:6.3f} m, ANEES {:.2f}; before {}\n",
        seed, drive.until_said_s, drive.until_found_s, 100.0 * drive.tracking, drive.tracking_m, drive.anees,
        drive.said_before);
  }
  fmt::print(
      "{}: said within 3 s in {} of {}, at home within 5 s in {}, nothing said before in {}; worst while tracking "
      "{:.2f} m, ANEES {:.2f}\n",
      title, said, kDrives, found, silent_before, worst_m, worst_anees);
  EXPECT_GE(said, fewest.said);
  EXPECT_GE(found, fewest.found);
  EXPECT_GE(honest, fewest.honest);
  EXPECT_LE(worst_anees, fewest.worst_anees);
}

EncoderRobot next_door_and_back(bool camera_covered) {
  EncoderRobot robot{.laps = 1};
  robot.carried = {{.next_door = true, .camera_covered = camera_covered},
                   {.next_door = false, .camera_covered = camera_covered}};
  return robot;
}

/// The robot stands at another place, is carried to its starting point, and then drives. It sees all landmarks
/// throughout.
Run put_down_where_it_begins(std::uint64_t seed) {
  EncoderRobot robot{.laps = 1};
  robot.seed = seed;
  Run run = driven(robot);
  constexpr double kStands_s = 4.0, kIsCarried_s = 4.0, kPeriod_s = 0.2;
  const Pose2 begin = run.truth.front().T_world_body;
  const Duration before = duration_from_seconds(kStands_s + kIsCarried_s);
  for (OdometryReading& reading : run.odometry) reading.stamp += before;
  for (TruthPose& pose : run.truth) pose.stamp += before;
  for (BearingSet& set : run.bearings) set.stamp += before;
  std::vector<OdometryReading> odometry;
  std::vector<TruthPose> truth;
  std::vector<BearingSet> images;
  for (double t = 0.0; t < kStands_s + kIsCarried_s - 0.5 * kPeriod_s; t += kPeriod_s) {
    const double left = std::clamp((kStands_s + kIsCarried_s - t) / kIsCarried_s, 0.0, 1.0);
    const Pose2 here = begin * Pose2{2.0 * left, 1.0 * left, 1.0 * left};
    const Stamp stamp{duration_from_seconds(t)};
    odometry.push_back({.stamp = stamp, .T_odom_body = run.odometry.front().T_odom_body});
    truth.push_back({stamp, here});
    BearingSet& image = images.emplace_back();
    image.stamp = stamp;
    for (const TrueLandmark& landmark : run.landmarks) {
      const Eigen::Vector2d p = inverse(here) * Eigen::Vector2d(landmark.x_m, landmark.y_m);
      Bearing& bearing = image.bearings.emplace_back();
      bearing.azimuth_rad = std::atan2(p.y(), p.x());
      bearing.identity = landmark.identity;
    }
  }
  run.odometry.insert(run.odometry.begin(), odometry.begin(), odometry.end());
  run.truth.insert(run.truth.begin(), truth.begin(), truth.end());
  run.bearings.insert(run.bearings.begin(), images.begin(), images.end());
  return run;
}

// A daemon starts with its machine; somebody often puts the robot at its starting point afterwards.
TEST(PutDown, BeforeItDrivesIsNotLostForGood) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto run = put_down_where_it_begins(seed);
    const Rig rig = rig_of(run);
    const ReplayResult result = replay(run, rig, configured_estimator(rig, {}), StageSettings{});
    std::size_t tracked = 0;
    for (const StepHealth& step : result.healths) tracked += step.health == Health::tracking ? 1 : 0;
    fmt::print("seed {}: {} of {} steps tracking, at the end {}: {}\n", seed, tracked, result.healths.size(),
               to_string(result.healths.back().health), result.healths.back().reason);
    EXPECT_EQ(result.healths.back().health, Health::tracking) << seed;
    EXPECT_GE(2 * tracked, result.healths.size()) << seed;
  }
}

TEST(CarriedOff, UnseenIsFoundOutByNames) { expect_found_out(next_door_and_back(true), "unseen"); }
TEST(CarriedOff, SeenIsFoundOutByNames) { expect_found_out(next_door_and_back(false), "seen"); }

// One of twenty rooms next door resembles home in one or two images.
TEST(CarriedOff, UnseenIsFoundOutWithoutNames) {
  EncoderRobot robot = next_door_and_back(true);
  robot.names = false;
  expect_found_out(robot, "unseen, no names", {.worst_anees = 100.0});
}

// Images taken while the robot is carried distort the map until the estimator notices the carrying.
TEST(CarriedOff, SeenIsFoundOutWithoutNames) {
  EncoderRobot robot = next_door_and_back(false);
  robot.names = false;
  expect_found_out(robot, "seen, no names", {.found = 15});
}

}  // namespace
}  // namespace azimuth
