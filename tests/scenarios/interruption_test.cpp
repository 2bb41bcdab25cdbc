// A robot without bearings for a long time, and a robot that stands still for a long time.

#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <memory>

#include "sim/world/simulate.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/simulated_drive.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kGapSeeds = 10;

TEST(Gap, TwoMinutesInTheDarkAreSurvived) {
  // GIVEN six laps, of which nearly two pass without a single bearing
  const auto interrupted = [](std::uint64_t seed) {
    auto run = simulated_run(lab(seed, 6));
    std::erase_if(run.bearings,
                  [](const BearingSet& set) { return to_seconds(set.stamp) > 150.0 && to_seconds(set.stamp) < 270.0; });
    return run;
  };
  // WHEN bearings arrive again
  const Runs runs = replay_seeds(kGapSeeds, [&](std::uint64_t seed) { return replayed(interrupted(seed)); });
  runs.print("lab, two minutes dark");
  // THEN the robot relocalises on its old map
  int found = 0;
  for (const Report& report : runs.reports)
    found += report.position_m.final < 0.2 && report.named_map.duplicates == 0 && report.health == "tracking" ? 1 : 0;
  fmt::print("found again: {} of {}\n", found, kGapSeeds);
  EXPECT_GE(found, kGapSeeds - 1);
}

/// The world of `scenario` with a rest inserted at `when`, during which camera and odometer continue to measure.
World with_rest(const Scenario& scenario, Stamp when, Duration rest) {
  World world = simulate(scenario);
  const Pose2 T_world_body = true_pose(world, when);
  World rested;
  std::optional<Pose2> T_odom_body;
  for (OdometryReading reading : world.odometry) {
    if (reading.stamp >= when) {
      if (!T_odom_body) {
        T_odom_body = reading.T_odom_body;
        for (Duration t{0}; t < rest; t += std::chrono::milliseconds(100))
          rested.odometry.push_back({reading.stamp + t, rested.odometry.size(), 0, *T_odom_body});
      }
      reading.stamp += rest;
    }
    reading.sequence = rested.odometry.size();
    rested.odometry.push_back(reading);
  }
  Random random(scenario.seed, RandomPurpose::bearings);
  bool has_rested = false;
  for (BearingSet set : world.bearings) {
    if (set.stamp >= when) {
      for (Duration t{0}; !has_rested && t < rest; t += std::chrono::milliseconds(200)) {
        BearingSet seen = observe(scenario.landmarks, T_world_body, scenario.sensor, random);
        seen.stamp = set.stamp + t;
        rested.bearings.push_back(seen);
      }
      has_rested = true;
      set.stamp += rest;
    }
    rested.bearings.push_back(set);
  }
  for (TruePose pose : world.truth) {
    if (pose.stamp >= when) pose.stamp += rest;
    rested.truth.push_back(pose);
  }
  return rested;
}

double sigma_m(const Estimate& estimate) { return std::sqrt(estimate.pose_covariance.topLeftCorner<2, 2>().trace()); }
double sigma_heading_rad(const Estimate& estimate) { return std::sqrt(estimate.pose_covariance(2, 2)); }

void expect_as_sure_after_ten_minutes(const std::function<std::unique_ptr<Estimator>(const Rig& rig)>& make_estimator) {
  const Stamp when{std::chrono::seconds(100)};
  const Duration rest = std::chrono::minutes(10);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    // GIVEN a robot in its second lap
    const Scenario scenario = lab(seed, 3);
    const World world = with_rest(scenario, when, rest);
    const Rig rig = rig_of(scenario);
    StagedDrive drive(make_estimator(rig), rig);
    drive.run(world, when);
    const Estimate before = drive.last();
    // WHEN it stands still for ten minutes
    drive.run(world, when + rest - std::chrono::seconds(1));
    const Estimate after = drive.last();
    // THEN its covariance has not grown, and 1200 images of the same landmarks have not made it overconfident
    fmt::print("rest, seed {}: sigma {:.4f} -> {:.4f} m, {:.5f} -> {:.5f} rad, error {:.4f} -> {:.4f} m\n", seed,
               sigma_m(before), sigma_m(after), sigma_heading_rad(before), sigma_heading_rad(after),
               position_error_m(world, before), position_error_m(world, after));
    EXPECT_LE(sigma_m(after), sigma_m(before));
    EXPECT_GE(sigma_m(after), 0.4 * sigma_m(before));
    EXPECT_LE(sigma_heading_rad(after), sigma_heading_rad(before));
    EXPECT_GE(sigma_heading_rad(after), 0.4 * sigma_heading_rad(before));
    EXPECT_LT(position_error_m(world, after), 4.0 * sigma_m(after));
    EXPECT_EQ(after.health, Health::tracking);
    // AND the robot continues its drive as before
    drive.run(world);
    EXPECT_LT(position_error_m(world, drive.last()), 0.15);
    EXPECT_EQ(drive.last().health, Health::tracking);
  }
}

TEST(Rest, TenMinutesOfStandingStillLeaveThePoseAsSureAsItWas) {
  for (const Initialisation initialisation : {Initialisation::delayed, Initialisation::undelayed}) {
    EkfSettings settings;
    settings.initialisation = initialisation;
    expect_as_sure_after_ten_minutes([&](const Rig& rig) { return std::make_unique<EkfEstimator>(rig, settings); });
  }
}

TEST(Rest, NorDoTheyChangeMuchInHindsight) {
  expect_as_sure_after_ten_minutes([](const Rig& rig) { return make_smoother_estimator(rig, {}); });
}

}  // namespace
}  // namespace azimuth
