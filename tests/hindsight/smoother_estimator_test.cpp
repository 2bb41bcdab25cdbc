// The smoother behind the common estimator interface.

#include "slam/hindsight/smoother_estimator.hpp"

#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <set>

#include "sim/world/simulate.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

Scenario short_lab() { return lab(3, 1); }

struct Drive : StagedDrive {
  explicit Drive(const Scenario& scenario, const HindsightSettings& settings = {})
      : StagedDrive(make_smoother_estimator(rig_of(scenario), settings), rig_of(scenario)) {}
};

TEST(SmootherEstimator, MapsALabAndSaysHowWellItKnowsIt) {
  const Scenario scenario = short_lab();
  const World world = simulate(scenario);
  Drive drive(scenario);
  drive.run(world);
  EXPECT_EQ(drive.last().health, Health::tracking);
  EXPECT_LT(position_error_m(world, drive.last()), 0.15);
  ASSERT_GE(drive.last().landmarks.size(), 20U);
  const Pose2 T_world_map = true_pose(world, world.bearings.front().stamp);
  for (const LandmarkEstimate& landmark : drive.last().landmarks) {
    const WorldLandmark& there = scenario.landmarks[static_cast<std::size_t>(landmark.identity)];
    const Eigen::Vector2d off = T_world_map * landmark.p_map_landmark_m - there.p_world_landmark_m;
    EXPECT_LT(off.norm(), 0.5) << landmark.identity;
    EXPECT_GT(landmark.covariance_m2.determinant(), 0.0);
  }
}

TEST(SmootherEstimator, BeginsWithoutALandmark) {
  const Scenario scenario = short_lab();
  Drive drive(scenario);
  Estimate first;
  drive.on_estimate = [&](const Estimate& estimate) {
    if (first.step == 0) first = estimate;
  };
  drive.run(simulate(scenario), Stamp{} + std::chrono::seconds(2));
  EXPECT_EQ(first.health, Health::starting);
  EXPECT_TRUE(first.landmarks.empty());
}

TEST(SmootherEstimator, TheNewestOfThePastIsThePresent) {
  const Scenario scenario = short_lab();
  const World world = simulate(scenario);
  Drive drive(scenario);
  std::size_t steps = 0;
  drive.on_estimate = [&](const Estimate& /*estimate*/) { ++steps; };
  drive.run(world);
  std::vector<PastPose> past;
  ASSERT_TRUE(drive.stage().estimator().write_past(past));
  ASSERT_EQ(past.size(), steps);
  EXPECT_EQ(past.back().stamp, drive.last().stamp);
  EXPECT_LT((past.back().T_map_body.vector() - drive.last().T_map_body.vector()).norm(), 1e-9);
  EXPECT_LT((past.back().covariance - drive.last().pose_covariance).norm(), 1e-9);
  for (std::size_t i = 1; i < past.size(); ++i) EXPECT_GT(past[i].stamp, past[i - 1].stamp);
}

TEST(SmootherEstimator, TheSameDriveGivesTheSameBits) {
  const Scenario scenario = short_lab();
  const World world = simulate(scenario);
  Drive one(scenario), other(scenario);
  one.run(world);
  other.run(world);
  EXPECT_EQ(one.last().T_map_body, other.last().T_map_body);
  EXPECT_EQ(one.last().pose_covariance, other.last().pose_covariance);
}

TEST(SmootherEstimator, ACameraThatIsTurnedSeesTheSameMap) {
  Scenario scenario = short_lab();
  const World straight = simulate(scenario);
  Drive drive(scenario);
  drive.run(straight);
  scenario.sensor.yaw_offset_rad = 0.7;
  World turned = straight;
  for (BearingSet& set : turned.bearings)
    for (Bearing& bearing : set.bearings) bearing.azimuth_rad = wrap(bearing.azimuth_rad - 0.7);
  Drive other(scenario);
  other.run(turned);
  EXPECT_LT((drive.last().T_map_body.vector() - other.last().T_map_body.vector()).norm(), 1e-6);
  ASSERT_FALSE(other.last().accepted.empty());
  // Published sightings carry the azimuths in the camera's frame.
  const AcceptedSighting& seen = other.last().accepted.front();
  bool found = false;
  for (const BearingSet& set : turned.bearings)
    for (const Bearing& bearing : set.bearings)
      found = found || std::abs(wrap(bearing.azimuth_rad - seen.azimuth_rad)) < 1e-9;
  EXPECT_TRUE(found);
}

TEST(SmootherEstimator, ExpectsLandmarksWhereTheyAreSeen) {
  Scenario scenario = short_lab();
  scenario.sensor.yaw_offset_rad = -0.4;
  const World world = simulate(scenario);
  Drive drive(scenario);
  std::size_t inside = 0, all = 0;
  drive.run(world);
  std::vector<ExpectedBearing> expected;
  drive.stage().estimator().expect(expected);
  ASSERT_FALSE(expected.empty());
  for (const AcceptedSighting& seen : drive.last().accepted)
    for (const ExpectedBearing& bearing : expected)
      if (bearing.landmark == seen.landmark_id) {
        ++all;
        inside += std::abs(wrap(bearing.azimuth_rad - seen.azimuth_rad)) < bearing.gate_rad ? 1 : 0;
      }
  EXPECT_GT(all, 0U);
  EXPECT_EQ(inside, all);
}

TEST(SmootherEstimator, LooksAheadByOdometryAlone) {
  const Scenario scenario = short_lab();
  Drive drive(scenario);
  drive.run(simulate(scenario));
  Motion motion;
  append(motion, {0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, {1e-3, 1e-3, 1e-3, 0.0});
  Estimate ahead;
  drive.stage().estimator().look_ahead(motion, ahead);
  const Pose2 there = drive.last().T_map_body * Pose2{0.5, 0.0, 0.0};
  EXPECT_LT((ahead.T_map_body.vector() - there.vector()).norm(), 1e-9);
  EXPECT_GT(ahead.pose_covariance.trace(), drive.last().pose_covariance.trace());
}

TEST(SmootherEstimator, SavesTheMapThatItPublishes) {
  const Scenario scenario = short_lab();
  // The scale's error is part of the published covariance but not of the saved one, so that the next map does not count
  // it twice.
  HindsightSettings exact;
  exact.consider_distance = false;
  Drive drive(scenario, exact);
  drive.run(simulate(scenario));
  MapSnapshot map;
  ASSERT_TRUE(drive.stage().save_map(map));
  EXPECT_EQ(map.names, MapNames::sensor);
  ASSERT_EQ(map.landmarks.size(), drive.last().landmarks.size());
  ASSERT_EQ(map.covariance.size(), map.entries());
  EXPECT_LT((map.T_map_body.vector() - drive.last().T_map_body.vector()).norm(), 1e-9);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(map.covariance(i, i), drive.last().pose_covariance(static_cast<int>(i), static_cast<int>(i)), 1e-9);
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    const LandmarkEstimate& published = drive.last().landmarks[i];
    const std::size_t row = map.first_landmark_entry() + 2 * i;
    EXPECT_EQ(map.landmarks[i].id, published.id);
    EXPECT_EQ(map.landmarks[i].p_map_landmark_m, published.p_map_landmark_m);
    EXPECT_NEAR(map.covariance(row, row), published.covariance_m2(0, 0), 1e-9);
    EXPECT_NEAR(map.covariance(row + 1, row), published.covariance_m2(1, 0), 1e-9);
    EXPECT_LT(published.id, map.next_id);
  }
}

TEST(SmootherEstimator, NothingIsSavedBeforeThereIsAnything) {
  MapSnapshot map;
  EXPECT_FALSE(make_smoother_estimator(rig_of(short_lab()), {})->save_map(map));
}

TEST(SmootherEstimator, WithoutNamesItLooksAtNone) {
  Scenario scenario = short_lab();
  World world = simulate(scenario);
  world.bearings.resize(200);
  HindsightSettings few;
  few.members = 2;
  few.names = false;
  Drive named(scenario, few);
  named.run(world);
  for (BearingSet& set : world.bearings)
    for (Bearing& bearing : set.bearings) bearing.identity = kUnknownIdentity;
  Drive stripped(scenario, few);
  stripped.run(world);
  EXPECT_EQ(named.last().T_map_body, stripped.last().T_map_body);
  for (const LandmarkEstimate& landmark : named.last().landmarks) EXPECT_EQ(landmark.identity, kUnknownIdentity);
}

/// The samples of the world from an instant on.
World rest_of(const World& world, Stamp from) {
  World rest = world;
  std::erase_if(rest.bearings, [&](const BearingSet& set) { return set.stamp < from; });
  std::erase_if(rest.odometry, [&](const OdometryReading& reading) { return reading.stamp < from; });
  return rest;
}

TEST(SmootherEstimator, WithoutNamesItGoesOnFromItsMapWhereThePoseIsKnown) {
  const Scenario scenario = short_lab();
  const World world = simulate(scenario);
  const Stamp stop = world.bearings.front().stamp + std::chrono::seconds(60);
  HindsightSettings nameless;
  nameless.names = false;
  Drive first(scenario, nameless);
  first.run(world, stop);
  MapSnapshot map;
  ASSERT_TRUE(first.stage().save_map(map));
  ASSERT_GE(map.landmarks.size(), 10U);
  EXPECT_EQ(map.names, MapNames::none);
  std::set<std::int64_t> saved;
  for (const MapLandmark& landmark : map.landmarks) saved.insert(landmark.id);

  const MapStart nowhere{.map = &map}, here{.map = &map, .pose_known = true};
  EXPECT_TRUE(why_unfit_for_smoother(map, rig_of(scenario), nameless, nowhere));
  EXPECT_FALSE(why_unfit_for_smoother(map, rig_of(scenario), nameless, here));
  StagedDrive second(make_smoother_estimator(rig_of(scenario), nameless, here), rig_of(scenario));
  std::size_t new_ones = 0, old_ones = 0;
  second.on_estimate = [&](const Estimate& estimate) {
    new_ones = old_ones = 0;
    for (const LandmarkEstimate& landmark : estimate.landmarks) {
      ++(saved.contains(landmark.id) ? old_ones : new_ones);
      EXPECT_TRUE(saved.contains(landmark.id) || landmark.id >= map.next_id) << landmark.id;
    }
  };
  second.run(rest_of(world, stop));
  EXPECT_GE(old_ones + 2, saved.size());
  EXPECT_LE(saved.size(), scenario.landmarks.size() + 2);
  EXPECT_LE(new_ones, 2U) << "known ones are mapped once more";
  EXPECT_LT(position_error_m(world, second.last()), 0.3);
}

}  // namespace
}  // namespace azimuth
