// Tests the calibration of odometry and camera heading from a simulated drive.

#include "tools/drive_fit/calibration.hpp"

#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/support/drive_of.hpp"
#include "tests/support/spoilt_run.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

OdometryCalibration calibrated(const Run& run) {
  const Rig rig = test::rig_of_run(run);
  return calibrate_odometry(test::drive_of(run, rig), rig, {});
}

TEST(CalibrateOdometry, FindsTurnDriftAndLagAndHowWellItKnowsThem) {
  // GIVEN odometry with errors that the rig does not contain
  const auto run =
      test::with_late_odometry(test::with_drift(test::with_scaled_turns(simulated_run(lab(21, 2)), 1.08), 0.02), 0.15);
  const OdometryCalibration found = calibrated(run);
  ASSERT_TRUE(found.turn.told && found.drift.told && found.lag.told);
  // THEN the errors are found; the drift was added to the scaled turns, hence the division by 1.08
  EXPECT_NEAR(found.turn.value, 1.0 / 1.08, 3.0 * found.turn.sigma);
  EXPECT_NEAR(found.drift.value, -0.02 / 1.08, 3.0 * found.drift.sigma);
  EXPECT_NEAR(found.lag.value, -0.15, 3.0 * found.lag.sigma);
  EXPECT_LT(found.turn.sigma, 0.03);
  EXPECT_LT(found.drift.sigma, 0.02);
  EXPECT_LT(found.lag.sigma, 0.05);
  EXPECT_GT(found.solution.fitting, 0.95);
}

TEST(CalibrateOdometry, FindsHowFarHeadingsWander) {
  // GIVEN a rig whose variance of the heading drift is ten times too small or too large
  const auto run = simulated_run(lab(22, 2));
  for (const double wrong : {0.1, 10.0}) {
    Rig rig = test::rig_of_run(run);
    rig.odometry.lambda_drift_rad2_per_m *= wrong;
    const OdometryCalibration found = calibrate_odometry(test::drive_of(run, rig), rig, {});
    ASSERT_TRUE(found.noise.of(NoiseSort::drift).is_told());
    const double times = found.noise.of(NoiseSort::drift).variance / 1e-3;  // ratio to the variance of the simulation
    EXPECT_GT(times, 0.5) << wrong;
    EXPECT_LT(times, 2.0) << wrong;
  }
}

TEST(CalibrateOdometry, TakesNoNoiseFartherDownThanOneDriveProves) {
  // GIVEN a rig whose noise of turns is a hundred times too large
  const auto run = simulated_run(lab(22, 1));
  Rig rig = test::rig_of_run(run);
  rig.odometry.lambda_rotation_rad *= 100.0;
  const OdometryCalibration found = calibrate_odometry(test::drive_of(run, rig), rig, {});
  // THEN the written noise is the safe one: one drive reduces it by a factor of 9 at most
  EXPECT_GE(found.solution.guess.rig.odometry.lambda_rotation_rad, 0.999 * rig.odometry.lambda_rotation_rad / 9.0);
  for (const OdometryNoise::Told& noise : found.noise.sorts) EXPECT_GT(noise.safe_variance, noise.variance);
}

TEST(CalibrateOdometry, CoversAnOdometerThatCreeps) {
  const auto good = simulated_run(lab(22, 1));
  const Rig rig = test::rig_of_run(good);
  const OdometryCalibration sound = calibrate_odometry(test::drive_of(good, rig), rig, {});
  EXPECT_FALSE(sound.creep.is_told());
  EXPECT_EQ(sound.solution.guess.rig.odometry.floor_rotation_rad, rig.odometry.floor_rotation_rad);
  const auto crept = test::with_creep(good, 20.0, 0.005, 0.003);
  const OdometryCalibration found = calibrate_odometry(test::drive_of(crept, rig), rig, {});
  ASSERT_TRUE(found.creep.is_told());
  EXPECT_NEAR(found.solution.guess.rig.odometry.floor_rotation_rad, 0.005, 0.0005);
  EXPECT_NEAR(found.solution.guess.rig.odometry.floor_distance_m, 0.003, 0.0005);
}

TEST(CalibrateOdometry, OfARobotThatNeverTurnsTheScaleOfTurnsIsNotTold) {
  Scenario scenario = corridor(23);
  scenario.path.resize(2);  // one way only
  const auto run = simulated_run(scenario);
  const Rig rig = test::rig_of_run(run);
  const OdometryCalibration found = calibrate_odometry(test::drive_of(run, rig), rig, {});
  EXPECT_FALSE(found.turn.told);
  EXPECT_EQ(found.solution.guess.rig.odometry.scale_turn, rig.odometry.scale_turn);
}

TEST(CalibrateHeading, FindsHandAndOffset) {
  for (const double yaw_rad : {-1.2, 0.0, 2.8})
    for (const bool mirrored : {false, true}) {
      auto run = test::with_turned_camera(simulated_run(lab(24, 1)), -yaw_rad);
      if (mirrored) run = test::with_mirrored_azimuths(std::move(run));
      const Rig rig = test::rig_of_run(run);
      const HeadingCalibration found = calibrate_heading(test::drive_of(run, rig), rig, {});
      EXPECT_TRUE(found.hand_told);
      EXPECT_EQ(found.mirrored, mirrored);
      EXPECT_NEAR(rad_to_degrees(wrap(found.yaw.value - yaw_rad)), 0.0, 0.5) << yaw_rad << ' ' << mirrored;
    }
}

TEST(CalibrateHeading, FindsWhereTheCameraStands) {
  Scenario scenario = lab(26, 1);
  scenario.sensor.position_m = {0.25, -0.15};
  const auto run = simulated_run(scenario);
  Rig rig = test::rig_of_run(run);
  rig.camera.position_m = {};
  const HeadingCalibration found = calibrate_heading(test::drive_of(run, rig), rig, {});
  ASSERT_TRUE(found.ahead.told && found.left.told);
  EXPECT_NEAR(found.ahead.value, 0.25, 0.02);
  EXPECT_NEAR(found.left.value, -0.15, 0.02);
  EXPECT_EQ(found.solution.guess.rig.camera.position_m[0], found.ahead.value);
  EXPECT_NEAR(rad_to_degrees(found.yaw.value), 0.0, 0.5);
}

// A robot that hardly turns cannot tell a camera ahead of the axle from a lag.
TEST(CalibrateHeading, ADriveThatTellsNoPositionLeavesItAsItWas) {
  auto run = first_seconds(simulated_run(lab(26, 1)), 12.0);
  Rig rig = test::rig_of_run(run);
  rig.camera.position_m = {0.1, 0.0};
  const HeadingCalibration found = calibrate_heading(test::drive_of(run, rig), rig, {});
  EXPECT_FALSE(found.ahead.told || found.left.told);
  EXPECT_EQ(found.solution.guess.rig.camera.position_m, rig.camera.position_m);
}

TEST(Calibrations, SayWhyADriveCannotTell) {
  auto run = simulated_run(lab(25, 1));
  const Rig rig = test::rig_of_run(run);
  EXPECT_EQ(why_cannot_tell(test::drive_of(run, rig), rig), "");
  auto brief = run;
  brief.bearings.resize(2);
  EXPECT_NE(why_cannot_tell(test::drive_of(brief, rig), rig).find("cannot tell: of"), std::string::npos);
  for (BearingSet& set : run.bearings)
    for (Bearing& bearing : set.bearings) bearing.identity = kUnknownIdentity;
  EXPECT_NE(why_cannot_tell(test::drive_of(run, rig), rig).find("camera.identities"), std::string::npos);
}

}  // namespace
}  // namespace azimuth
