// A robot that drives round the lab without stopping.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scenarios/replayed.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kLabSeeds = 10;

TEST(Lab, ThreeLapsAreTrackedToCentimetres) {
  // GIVEN three laps with odometry at 10 Hz and bearings at 5 Hz
  // WHEN they are replayed with the default settings
  const Runs runs = replay_seeds(kLabSeeds, [](std::uint64_t seed) { return replayed(simulated_run(lab(seed))); });
  runs.print("lab");
  // THEN the loop closes
  EXPECT_EQ(runs.diverged(), 0);
  EXPECT_LE(runs.mean_m(), 0.06);
}

TEST(Lab, EitherInitialisationServes) {
  for (const Initialisation initialisation : {Initialisation::delayed, Initialisation::undelayed}) {
    EkfSettings settings;
    settings.initialisation = initialisation;
    const Runs runs =
        replay_seeds(kLabSeeds, [&](std::uint64_t seed) { return replayed(simulated_run(lab(seed)), settings); });
    runs.print(initialisation == Initialisation::delayed ? "lab, delayed" : "lab, undelayed");
    EXPECT_EQ(runs.diverged(), 0);
    EXPECT_LE(runs.mean_m(), 0.06);
    EXPECT_GE(runs.anees(), 1.0);  // low because the rig is exact, which the filter does not assume
    EXPECT_LE(runs.anees(), 5.0);
  }
}

TEST(Lab, ClutterWithoutNamesIsTrackedToTheEnd) {
  constexpr int kManySeeds = 20;
  // GIVEN bearings without names, and one clutter bearing in every fifth image on average
  const auto cluttered = [](std::uint64_t seed) {
    Scenario scenario = lab(seed);
    scenario.sensor.identities = false;
    scenario.sensor.clutter_per_set = 0.2;
    return simulated_run(scenario);
  };
  // WHEN the estimator has to associate the bearings itself
  const Runs runs = replay_seeds(kManySeeds, [&](std::uint64_t seed) { return replayed(cluttered(seed)); });
  runs.print("lab, no names, clutter");
  // THEN it beats odometry on average and in most runs; in the others an early association is wrong
  const auto better = std::ranges::count_if(
      runs.reports, [](const Report& report) { return report.position_m.mean < report.odometry_m.mean; });
  const double odometry_m = runs.mean_of([](const Report& report) { return report.odometry_m.mean; });
  fmt::print("better than odometry: {} of {}\n", better, kManySeeds);
  EXPECT_LT(runs.mean_m(), 0.75 * odometry_m);
  EXPECT_GE(better, kManySeeds * 3 / 5);
}

TEST(Lab, CalibrationOfTheRigCorrectsTheOdometer) {
  // GIVEN wheels that are 4 % too small, turns that come 6 % short, a drift, and a lag
  const auto miscalibrated = [](std::uint64_t seed) {
    Scenario scenario = lab(seed);
    scenario.odometer.scale_distance = 0.96;
    scenario.odometer.scale_turn = 0.94;
    scenario.odometer.drift_rad_per_m = -0.03;
    scenario.odometer.lag_s = 0.2;
    return simulated_run(scenario);
  };
  // WHEN the rig states these errors, and when it does not
  const Runs known = replay_seeds(kLabSeeds, [&](std::uint64_t seed) { return replayed(miscalibrated(seed)); });
  const Runs unknown = replay_seeds(kLabSeeds, [&](std::uint64_t seed) {
    const auto run = miscalibrated(seed);
    Rig rig = rig_of(run);
    rig.odometry.scale_distance = rig.odometry.scale_turn = 1.0;
    rig.odometry.drift_rad_per_m = rig.odometry.lag_s = 0.0;
    return replayed(run, rig);
  });
  known.print("lab, calibrated");
  unknown.print("lab, not calibrated");
  // THEN the calibrated rig reaches the accuracy of a correct odometer
  EXPECT_EQ(known.diverged(), 0);
  EXPECT_LE(known.mean_m(), 0.06);
  EXPECT_LT(known.mean_m(), 0.7 * unknown.mean_m());
}

/// The same run for a robot that faces the other way and drives in reverse.
Run reversed(Run run) {
  const Pose2 half_turn{0.0, 0.0, -kPi};
  for (OdometryReading& reading : run.odometry)
    reading.T_odom_body = inverse(half_turn) * reading.T_odom_body * half_turn;
  for (TruthPose& truth : run.truth) truth.T_world_body = truth.T_world_body * half_turn;
  for (BearingSet& set : run.bearings)
    for (Bearing& bearing : set.bearings) bearing.azimuth_rad = wrap(bearing.azimuth_rad + kPi);
  return run;
}

TEST(Lab, DrivingBackwardsIsAsGoodAsDrivingForwards) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    // GIVEN a drive, and the same drive in reverse
    const auto forwards = simulated_run(lab(seed));
    // WHEN both are replayed
    const Report ahead = replayed(forwards), back = replayed(reversed(forwards));
    // THEN both have the same accuracy: driving in reverse costs no half turns
    EXPECT_NEAR(back.position_m.mean, ahead.position_m.mean, 1e-3);
    EXPECT_NEAR(back.consistency.anees, ahead.consistency.anees, 0.1);
    EXPECT_EQ(back.map.matched, ahead.map.matched);
  }
}

}  // namespace
}  // namespace azimuth
