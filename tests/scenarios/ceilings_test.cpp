// Disturbances of a camera that looks at a ceiling, for every lamp estimator: no lamps, one lamp, hundreds of
// reflections, lamps that move or are switched off. No estimator may crash, and health must report the problem.

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <set>

#include "slam/camera/camera_model.hpp"
#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "slam/geometry/rigid_alignment.hpp"
#include "slam/particles/make_fastslam_estimator.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

struct CeilingEstimator {
  const char* name;
  std::unique_ptr<Estimator> (*make)(const Rig& rig);
};
std::ostream& operator<<(std::ostream& out, const CeilingEstimator& kind) { return out << kind.name; }
const CeilingEstimator kKinds[] = {{"fastslam", [](const Rig& rig) { return make_fastslam_estimator(rig, {}); }},
                                   {"lamp_ekf", [](const Rig& rig) { return make_lamp_ekf_estimator(rig, {}); }}};

/// Result of a run, image by image.
struct Drive {
  std::vector<Health> health;
  std::vector<Eigen::Vector2d> poses, truth;
  std::vector<Eigen::Vector2d> odometry;
  Estimate last;

  int count(Health wanted, std::size_t from = 0) const {
    return static_cast<int>(std::count(health.begin() + static_cast<std::ptrdiff_t>(from), health.end(), wanted));
  }
};

double worst_error_m(const std::vector<Eigen::Vector2d>& estimated, const std::vector<Eigen::Vector2d>& truth) {
  const Pose2 T_world_map = align(estimated, truth);
  double worst_m = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    worst_m = std::max(worst_m, (T_world_map * estimated[i] - truth[i]).norm());
  return worst_m;
}

/// FastSLAM samples its poses: without corrections their error can be twice that of odometry.
double as_good_as_odometry_m(const Drive& drive) { return 2.0 * worst_error_m(drive.odometry, drive.truth) + 0.5; }

/// Checks that must hold for every estimate.
void expect_sound(const Estimate& estimate) {
  ASSERT_TRUE(estimate.T_map_body.vector().allFinite());
  ASSERT_TRUE(estimate.pose_covariance.allFinite());
  EXPECT_GE(estimate.pose_covariance.diagonal().minCoeff(), 0.0);
  EXPECT_EQ(estimate.reason.empty(), estimate.health == Health::tracking) << estimate.reason;
  if (estimate.landmarks.empty()) {
    EXPECT_EQ(estimate.health, Health::starting);
  }
  std::set<std::int64_t> ids;
  for (const LandmarkEstimate& lamp : estimate.landmarks) {
    ids.insert(lamp.id);
    EXPECT_TRUE(lamp.p_map_landmark_m.allFinite() && std::isfinite(lamp.z_map_landmark_m));
    EXPECT_GE(lamp.sigma_z_m, 0.0);
  }
  EXPECT_EQ(ids.size(), estimate.landmarks.size()) << "two landmarks of one name";
}

Drive drive(const LampRun& run, const CeilingEstimator& kind) {
  const std::unique_ptr<Estimator> estimator = kind.make(run.rig);
  Drive result;
  Pose2 T_odom_body;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator->predict(run.motions[i]);
    estimator->update(run.sets[i]);
    result.last = {};
    estimator->estimate(result.last);
    expect_sound(result.last);
    T_odom_body = T_odom_body * run.motions[i].T_start_end;
    result.health.push_back(result.last.health);
    result.poses.push_back(result.last.T_map_body.position());
    result.odometry.push_back(T_odom_body.position());
    result.truth.push_back(run.truth[i].position());
  }
  return result;
}

/// Removes the bearings that `keep` rejects, by image and lamp.
void keep_only(LampRun& run, const std::function<bool(std::size_t image, int lamp)>& keep) {
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    std::vector<Bearing> bearings;
    std::vector<int> lamps;
    for (std::size_t l = 0; l < run.lamp_of[i].size(); ++l) {
      if (!keep(i, run.lamp_of[i][l])) continue;
      bearings.push_back(run.sets[i].bearings[l]);
      lamps.push_back(run.lamp_of[i][l]);
    }
    run.sets[i].bearings = bearings;
    run.lamp_of[i] = lamps;
  }
}

Bearing sighting_of(const LampRun& run, std::size_t image, const Eigen::Vector3d& lamp) {
  const Eigen::Vector2d flat = inverse(run.truth[image]) * Eigen::Vector2d(lamp.head<2>());
  const Direction seen =
      direction(Eigen::Vector3d(flat.x(), flat.y(), lamp.z() - *run.rig.camera.image.viewpoint_height_m));
  return {.azimuth_rad = seen.azimuth_rad, .elevation_rad = seen.elevation_rad};
}

/// Number of mapped landmarks that are more than 1.5 m from every lamp.
int phantoms(const Drive& drive, const LampRun& run) {
  const Pose2 T_world_map = align(drive.poses, drive.truth);
  return static_cast<int>(std::ranges::count_if(drive.last.landmarks, [&](const LandmarkEstimate& mapped) {
    const Eigen::Vector2d flat = T_world_map * mapped.p_map_landmark_m;
    return std::ranges::none_of(run.lamps, [&](const Eigen::Vector3d& lamp) {
      return (lamp - Eigen::Vector3d(flat.x(), flat.y(), mapped.z_map_landmark_m)).norm() < 1.5;
    });
  }));
}

class Ceilings : public testing::TestWithParam<CeilingEstimator> {};
INSTANTIATE_TEST_SUITE_P(All, Ceilings, testing::ValuesIn(kKinds),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Ceilings, WithoutLampsThePoseIsOdometry) {
  LampRun run = simulated_hall(1);
  keep_only(run, [](std::size_t, int) { return false; });
  const Drive blind = drive(run, GetParam());
  EXPECT_EQ(blind.count(Health::starting), static_cast<int>(run.sets.size()));
  EXPECT_TRUE(blind.last.landmarks.empty());
  EXPECT_LT(worst_error_m(blind.poses, blind.truth), as_good_as_odometry_m(blind));
}

TEST_P(Ceilings, OneLampIsUsedAsFarAsItGoes) {
  LampRun run = simulated_hall(2);
  keep_only(run, [](std::size_t, int lamp) { return lamp == 5; });
  const Drive one = drive(run, GetParam());
  EXPECT_EQ(one.last.landmarks.size(), 1u);
  EXPECT_EQ(phantoms(one, run), 0);
  EXPECT_GT(one.count(Health::tracking), static_cast<int>(run.sets.size()) / 4);
  EXPECT_LT(worst_error_m(one.poses, one.truth), as_good_as_odometry_m(one));
}

/// Random reflections, each at a new place, as from a wet floor, chromium or the sun through leaves.
void dazzle(LampRun& run, std::size_t from_image) {
  RandomDraws draws(3);
  for (std::size_t i = from_image; i < run.sets.size(); ++i) {
    for (int k = 0; k < 300; ++k)
      run.sets[i].bearings.push_back(
          {.azimuth_rad = draws.uniform(-kPi, kPi), .elevation_rad = std::asin(draws.uniform(0.35, 1.0))});
    std::ranges::sort(run.sets[i].bearings, {}, &Bearing::azimuth_rad);  // mixes the lamps with the reflections
  }
}

TEST_P(Ceilings, HundredsOfReflectionsDoNotCarryTheRobotAway) {
  LampRun run = simulated_hall(3);
  dazzle(run, 0);
  const Drive dazzled = drive(run, GetParam());
  EXPECT_LT(worst_error_m(dazzled.poses, dazzled.truth), as_good_as_odometry_m(dazzled));
}

TEST_P(Ceilings, KnownLampsAreFoundAmongHundredsOfReflections) {
  LampRun run = simulated_hall(3);
  const std::size_t half = run.sets.size() / 2;
  dazzle(run, half);
  const Drive dazzled = drive(run, GetParam());
  EXPECT_EQ(dazzled.count(Health::tracking, half), static_cast<int>(run.sets.size() - half));
  EXPECT_GE(static_cast<int>(dazzled.last.landmarks.size()) - phantoms(dazzled, run), 15);
  EXPECT_LT(worst_error_m(dazzled.poses, dazzled.truth), 0.7);
}

/// Reflections fixed to the robot, such as its own lamps on a guard, always appear in the same direction.
TEST_P(Ceilings, WhatRidesAlongIsNotMapped) {
  LampRun run = simulated_hall(4);
  for (std::size_t i = 0; i < run.sets.size(); ++i)
    for (int k = 0; k < 4; ++k) {
      run.sets[i].bearings.push_back({.azimuth_rad = wrap(0.4 + 1.6 * k), .elevation_rad = 0.6 + 0.1 * k});
      run.lamp_of[i].push_back(LampRun::kClutter);
    }
  const Drive guarded = drive(run, GetParam());
  EXPECT_LE(phantoms(guarded, run), 2);
  EXPECT_GT(guarded.count(Health::tracking, run.sets.size() / 2), static_cast<int>(run.sets.size()) * 45 / 100);
  EXPECT_LT(worst_error_m(guarded.poses, guarded.truth), 1.0);
}

/// A lamp on a crane moves back and forth by 2 m.
TEST_P(Ceilings, ALampThatMovesDoesNotTakeTheRobotAlong) {
  LampRun run = simulated_hall(5);
  constexpr int kMoving = 6;
  keep_only(run, [](std::size_t, int lamp) { return lamp != kMoving; });
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    const double swing_m = 2.0 * std::sin(2.0 * kPi * static_cast<double>(i) / 40.0);
    const Bearing seen = sighting_of(run, i, run.lamps[kMoving] + Eigen::Vector3d(swing_m, 0.0, 0.0));
    if (seen.elevation_rad < kPi / 2.0 - *run.rig.camera.image.theta_max_rad) continue;
    run.sets[i].bearings.push_back(seen);
    run.lamp_of[i].push_back(LampRun::kClutter);
  }
  const Drive swung = drive(run, GetParam());
  EXPECT_LT(worst_error_m(swung.poses, swung.truth), 1.5);
  EXPECT_GE(swung.last.landmarks.size(), run.lamps.size() - 2);
  EXPECT_EQ(swung.last.health, Health::tracking) << swung.last.reason;
}

TEST_P(Ceilings, LampsSwitchedOffAreMissedAndRecognisedAgain) {
  LampRun run = simulated_hall(6);
  const std::size_t off = run.sets.size() / 2, on = off + 60;  // the lamps are off for 16 m of the drive
  keep_only(run, [&](std::size_t image, int) { return image < off || image >= on; });
  const Drive dark = drive(run, GetParam());
  EXPECT_EQ(dark.health[off - 1], Health::tracking);
  EXPECT_NE(dark.health[on - 1], Health::tracking) << "the pose has been odometry for long";
  EXPECT_EQ(dark.last.health, Health::tracking) << dark.last.reason;
  EXPECT_LT(worst_error_m(dark.poses, dark.truth), 1.5);
}

TEST_P(Ceilings, HalfTheLampsMayBeOff) {
  LampRun run = simulated_hall(7);
  const std::size_t off = run.sets.size() / 3, on = 2 * off;
  keep_only(run, [&](std::size_t image, int lamp) { return image < off || image >= on || lamp % 2 == 0; });
  const Drive half = drive(run, GetParam());
  EXPECT_GE(half.count(Health::tracking, off), static_cast<int>(run.sets.size() - off) * 9 / 10);
  EXPECT_LE(half.last.landmarks.size(), run.lamps.size() + 2) << "lamps that came back were mapped again";
  EXPECT_LT(worst_error_m(half.poses, half.truth), 1.0);
}

}  // namespace
}  // namespace azimuth
