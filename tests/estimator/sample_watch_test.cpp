#include "slam/estimator/sample_watch.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "slam/estimator/estimator_stage.hpp"
#include "slam/geometry/angle.hpp"
#include "tests/estimator/recording_estimator.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

constexpr Duration kWaitLimit{500'000};

/// The factors by which odometry is wrong when it is recorded in other units.
struct Mistake {
  double metre = 1.0, radian = 1.0, second = 1.0;
};

/// The pose of a robot that drives curves at 0.4 m/s and up to 0.5 rad/s, stops and turns on the spot.
Pose2 driven(double t_s) {
  Pose2 pose;
  constexpr double kStep_s = 0.01;
  for (double t = 0.0; t < t_s; t += kStep_s) {
    const bool stands = std::fmod(t, 10.0) > 8.0;
    const double turn_rad_s = stands ? 0.4 : 0.5 * std::sin(0.3 * t);
    pose = pose * Pose2{stands ? 0.0 : 0.4 * kStep_s, 0.0, turn_rad_s * kStep_s};
  }
  return pose;
}

SampleTrouble after_driving(const Mistake& mistake, double rate_hz = 20.0, const Rig& rig = {}) {
  SampleWatch watch(rig, kWaitLimit);
  std::uint64_t sequence = 0;
  for (double t_s = 0.0; t_s < 30.0; t_s += 1.0 / rate_hz) {
    const Pose2 pose = driven(t_s);
    watch.add(OdometryReading{
        .stamp = at_s(t_s * mistake.second),
        .sequence = sequence++,
        .T_odom_body = {pose.x_m * mistake.metre, pose.y_m * mistake.metre, wrap(pose.heading_rad * mistake.radian)}});
  }
  return watch.trouble();
}

SampleTrouble with_finding(const RigFinding& rig) {
  SampleWatch watch(Rig{}, kWaitLimit);
  watch.found(rig);
  return watch.trouble();
}

TEST(SampleWatch, SaysWhatTheEstimatorFoundOfTheRig) {
  EXPECT_EQ(with_finding({}), SampleTrouble::none);
  EXPECT_EQ(with_finding({.bearing_noise = 0.4, .odometry_noise = 1.4}), SampleTrouble::none);
  EXPECT_EQ(with_finding({.bearing_noise = 1.6}), SampleTrouble::bearings_scatter);
  EXPECT_EQ(with_finding({.odometry_noise = 1.6}), SampleTrouble::odometry_scatters);
  // A wrong rig constant makes the bearings seem noisy, too.
  RigFinding askew{.bearing_noise = 1.6};
  askew.yaw_offset_rad = RigFinding::Value{0.08, 0.002};
  EXPECT_EQ(with_finding(askew), SampleTrouble::rig_contradicted);
}

TEST(SampleWatch, KnowsWhatMakesAnyPoseWrong) {
  const auto impossible = [](const Mistake& mistake) {
    SampleWatch watch(Rig{}, kWaitLimit);
    for (int i = 0; i < 300; ++i) {
      const Pose2 pose = driven(0.1 * i);
      watch.add(OdometryReading{.stamp = at_s(0.1 * i),
                                .sequence = static_cast<std::uint64_t>(i),
                                .T_odom_body = {mistake.metre * pose.x_m, mistake.metre * pose.y_m, pose.heading_rad}});
    }
    return watch.impossible();
  };
  EXPECT_EQ(impossible({}), SampleTrouble::none);
  EXPECT_EQ(impossible({.metre = 1000.0}), SampleTrouble::odometry_too_fast);
}

TEST(SampleWatch, KnowsStepsThatNoWheelsMake) {
  SampleWatch watch(Rig{}, kWaitLimit);
  for (int i = 0; i < 300; ++i) {
    Pose2 pose = driven(0.1 * i);
    pose.x_m -= 0.7 * (i / 15);  // the wrap of a wheel's angle, without correction
    watch.add(OdometryReading{.stamp = at_s(0.1 * i), .sequence = static_cast<std::uint64_t>(i), .T_odom_body = pose});
  }
  EXPECT_EQ(watch.trouble(), SampleTrouble::odometry_jumps);
  EXPECT_GT(watch.finding().jumps, 15U);
  EXPECT_NEAR(watch.finding().largest_jump.step_m, 0.7, 0.1);
}

TEST(SampleWatch, KnowsImagesThatAreSeveralInOne) {
  SampleWatch watch(Rig{}, kWaitLimit);
  for (int i = 0; i < 20; ++i) {
    BearingSet set{.stamp = at_s(i), .sequence = static_cast<std::uint64_t>(i), .bearings = {}};
    for (const Identity identity : {1, 2, 1, 2}) set.bearings.push_back({.azimuth_rad = 0.1 * i, .identity = identity});
    watch.add(set);
  }
  EXPECT_EQ(watch.trouble(), SampleTrouble::names_repeated);
  EXPECT_EQ(watch.finding().repeating, 20U);
}

TEST(SampleWatch, LetsARobotDrive) {
  for (const double rate_hz : {1.0, 5.0, 20.0, 100.0}) EXPECT_EQ(after_driving({}, rate_hz), SampleTrouble::none);
}

TEST(SampleWatch, NoticesMillimetres) {
  for (const double rate_hz : {1.0, 5.0, 20.0, 100.0})
    EXPECT_EQ(after_driving({.metre = 1000.0}, rate_hz), SampleTrouble::odometry_too_fast) << rate_hz;
}

TEST(SampleWatch, TakesMillimetresThatTheRigKnowsOf) {
  Rig rig;
  rig.odometry.scale_distance = 0.001;
  EXPECT_EQ(after_driving({.metre = 1000.0}, 20.0, rig), SampleTrouble::none);
}

TEST(SampleWatch, NoticesDegreesOfAHeading) {
  for (const double rate_hz : {10.0, 20.0, 100.0})
    EXPECT_EQ(after_driving({.radian = 180.0 / kPi}, rate_hz), SampleTrouble::odometry_heading_in_degrees) << rate_hz;
}

TEST(SampleWatch, NoticesStampsThatRunTooSlowly) {
  EXPECT_EQ(after_driving({.second = 0.001}), SampleTrouble::none) << "30 ms are less than a window";
  EXPECT_EQ(after_driving({.second = 0.1}), SampleTrouble::none) << "4 m/s and 5 rad/s: why not";
  SampleWatch watch({}, kWaitLimit);
  for (int i = 0; i < 20'000; ++i) {  // half an hour compressed into 2 s
    const double t_s = 0.1 * i;
    watch.add({.stamp = at_s(0.001 * t_s * 1.0),
               .sequence = static_cast<std::uint64_t>(i),
               .T_odom_body = {0.4 * t_s, 0.0, wrap(0.5 * t_s)}});
  }
  watch.finish();
  EXPECT_EQ(watch.trouble(), SampleTrouble::odometry_too_quick);
}

/// The robot drives straight on for long while its heading turns. Wheels that only roll cannot do this, but the
/// headings are not in degrees either.
TEST(SampleWatch, LetsARobotDriveSideways) {
  SampleWatch watch({}, kWaitLimit);
  for (int i = 0; i < 2000; ++i)
    watch.add({.stamp = at_s(0.05 * i),
               .sequence = static_cast<std::uint64_t>(i),
               .T_odom_body = {0.02 * i, 0.0, wrap(0.03 * i)}});
  EXPECT_EQ(watch.trouble(), SampleTrouble::none);
}

TEST(SampleWatch, LetsStampsJitterAndAnOdometerRestart) {
  SampleWatch watch({}, kWaitLimit);
  for (int i = 0; i < 3000; ++i) {
    const double pair_s = 0.1 * (i / 2);  // pairs of readings, a microsecond apart
    watch.add({.stamp = at_s(pair_s + 1e-6 * (i % 2)),
               .sequence = static_cast<std::uint64_t>(i),
               .origin = static_cast<std::uint32_t>(i / 100),
               .T_odom_body = {0.02 * i + 1000.0 * (i / 100), 0.0, 0.0}});
  }
  EXPECT_EQ(watch.trouble(), SampleTrouble::none);
}

BearingSet set_of(double t_s, const Bearing& bearing, std::size_t count = 1) {
  return {.stamp = at_s(t_s), .sequence = 0, .bearings = std::vector<Bearing>(count, bearing)};
}

TEST(SampleWatch, NoticesDegreesOfBearings) {
  SampleWatch watch({}, kWaitLimit);
  watch.add(set_of(0.0, {.azimuth_rad = -170.0}, 3));
  EXPECT_EQ(watch.trouble(), SampleTrouble::bearings_in_degrees);
  EXPECT_EQ(watch.finding().largest_angle_rad, 170.0);
}

TEST(SampleWatch, NoticesIdentitiesThatThePromisedSensorDoesNotGive) {
  Rig rig;
  rig.camera.identities = true;
  SampleWatch watch(rig, kWaitLimit);
  for (int i = 0; i < 19; ++i) watch.add(set_of(i, {}));
  EXPECT_EQ(watch.trouble(), SampleTrouble::none);
  watch.add(set_of(19.0, {}));
  EXPECT_EQ(watch.trouble(), SampleTrouble::no_identities);
  watch.add(set_of(20.0, {.identity = 4}));
  EXPECT_EQ(watch.trouble(), SampleTrouble::none);
}

TEST(SampleWatch, IsLessPatientAtTheEnd) {
  Rig rig;
  rig.camera.identities = true;
  SampleWatch watch(rig, kWaitLimit);
  watch.add(set_of(0.0, {}));
  watch.finish();
  EXPECT_EQ(watch.trouble(), SampleTrouble::no_identities);
}

TEST(SampleWatch, NoticesImagesOfNoUse) {
  SampleWatch watch({}, kWaitLimit);
  BearingSet unreadable{.stamp = {}, .sequence = 0, .bearings = {}, .trouble = ImageTrouble::unreadable};
  for (int i = 0; i < 10; ++i) watch.add(unreadable);
  EXPECT_EQ(watch.trouble(), SampleTrouble::images_of_no_use);
  watch.add(set_of(1.0, {}));
  watch.finish();
  EXPECT_EQ(watch.trouble(), SampleTrouble::none) << "one is enough to know that the camera works";
}

/// The finding of a stage when no bearing set becomes a step.
class StageOfNoStep : public testing::Test {
 protected:
  SampleFinding after(double odometry_from_s, double odometry_step_s, int readings, double sets_from_s, int sets) {
    std::vector<RecordingEstimator::Step> steps;
    EstimatorStage stage(std::make_unique<RecordingEstimator>(steps), Rig{}, StageSettings{0.5});
    for (int i = 0; i < readings; ++i)
      stage.add(OdometryReading{.stamp = at_s(odometry_from_s + odometry_step_s * i),
                                .sequence = static_cast<std::uint64_t>(i),
                                .T_odom_body = {0.1 * i, 0.0, 0.0}});
    for (int i = 0; i < sets; ++i) {
      BearingSet set = set_of(sets_from_s + 0.1 * i, {.identity = 1});
      set.sequence = static_cast<std::uint64_t>(i);
      stage.add(set);
    }
    stage.finish();
    Estimate estimate;
    while (stage.advance(estimate)) ++steps_;
    return stage.samples().finding();
  }
  int steps_ = 0;
};

TEST_F(StageOfNoStep, SaysThatTheClocksDiffer) {
  const SampleFinding finding = after(0.0, 0.1, 100, 1000.0, 20);
  EXPECT_EQ(finding.trouble, SampleTrouble::apart_in_time);
  EXPECT_EQ(finding.without_odometry, 20U);
  EXPECT_EQ(steps_, 0);
}

TEST_F(StageOfNoStep, SaysThatOneReadingIsNoMotion) {
  EXPECT_EQ(after(0.0, 0.1, 1, 5.0, 20).trouble, SampleTrouble::one_reading);
  EXPECT_EQ(after(0.0, 0.1, 0, 0.0, 20).trouble, SampleTrouble::no_odometry);
}

TEST_F(StageOfNoStep, SaysThatReadingsAreTooFarApart) {
  EXPECT_EQ(after(0.0, 100.0, 50, 10.0, 20).trouble, SampleTrouble::odometry_too_rare);
}

TEST_F(StageOfNoStep, HasNothingToSayOfARunAsItShouldBe) {
  EXPECT_EQ(after(0.0, 0.1, 100, 1.0, 20).trouble, SampleTrouble::none);
  EXPECT_EQ(steps_, 20);
}

TEST(EstimatorStage, SaysWhyNoLandmarkIsMapped) {
  Rig rig;
  rig.camera.identities = true;
  std::vector<RecordingEstimator::Step> steps;
  EstimatorStage stage(std::make_unique<RecordingEstimator>(steps), rig, StageSettings{0.5});
  Estimate estimate;
  for (int i = 0; i < 30; ++i) {
    stage.add(OdometryReading{.stamp = at_s(0.1 * i), .sequence = static_cast<std::uint64_t>(i), .T_odom_body = {}});
    BearingSet set = set_of(0.1 * i, {});
    stage.add(set);
    while (stage.advance(estimate)) continue;
  }
  ASSERT_EQ(estimate.health, Health::starting);
  EXPECT_EQ(estimate.reason, "bearings carry no identities, which the rig promises");
}

/// The identities that the estimator receives for an image of a standing robot with these azimuths and identities.
std::vector<Identity> names_used(const Rig& rig, const std::vector<std::pair<double, Identity>>& seen,
                                 std::uint64_t& rejected) {
  std::vector<RecordingEstimator::Step> steps;
  EstimatorStage stage(std::make_unique<RecordingEstimator>(steps), rig, StageSettings{0.5});
  Estimate estimate;
  for (int i = 0; i < 2; ++i) {
    stage.add(OdometryReading{.stamp = at_s(0.1 * i), .sequence = static_cast<std::uint64_t>(i), .T_odom_body = {}});
    BearingSet set;
    set.stamp = at_s(0.1 * i);
    set.sequence = static_cast<std::uint64_t>(i);
    for (const auto& [azimuth_rad, identity] : seen)
      set.bearings.push_back({.azimuth_rad = azimuth_rad, .identity = identity});
    stage.add(set);
  }
  while (stage.advance(estimate)) continue;
  rejected = estimate.association.rejected;
  std::vector<Identity> names;
  EXPECT_EQ(steps.size(), 2U);
  if (!steps.empty())
    for (const Bearing& bearing : steps.back().set.bearings) names.push_back(bearing.identity);
  return names;
}

TEST(EstimatorStage, DoubtsANameThatOneImageHasSeveralTimes) {
  Rig rig;
  rig.camera.identities = true;
  rig.camera.sigma_bearing_rad = 0.02;
  constexpr Identity kNone = kUnknownIdentity;
  std::uint64_t rejected = 0;
  // WHEN bearings in three directions carry the identity 5, and two bearings in one direction, up to noise, carry 7
  const auto names = names_used(
      rig, {{1.0, 5}, {0.0, 7}, {-2.0, 5}, {0.5, 6}, {0.03, 7}, {2.5, 5}, {1.2, kNone}, {1.3, kNone}}, rejected);
  // THEN no bearing keeps 5, one keeps 7, and all other bearings are unchanged
  EXPECT_EQ(names, (std::vector<Identity>{kNone, 7, kNone, 6, kNone, kNone, kNone, kNone}));
  // AND the removed identities are counted as rejected, in both images
  EXPECT_EQ(rejected, 2U * 4U);
}

TEST(EstimatorStage, SeesOneThingWhereTheBearingsNoiseSaysSo) {
  Rig rig;
  rig.camera.identities = true;
  rig.camera.sigma_bearing_rad = 0.002;
  std::uint64_t rejected = 0;
  EXPECT_EQ(names_used(rig, {{3.14, 7}, {-3.14, 7}}, rejected), (std::vector<Identity>{7, kUnknownIdentity}));
  EXPECT_EQ(names_used(rig, {{3.12, 7}, {-3.12, 7}}, rejected),
            (std::vector<Identity>{kUnknownIdentity, kUnknownIdentity}));
}

TEST(EstimatorStage, LeavesNamesAloneThatTheRigDoesNotPromise) {
  std::uint64_t rejected = 0;
  EXPECT_EQ(names_used(Rig{}, {{1.0, 5}, {-2.0, 5}}, rejected), (std::vector<Identity>{5, 5}));
  EXPECT_EQ(rejected, 0U);
}

TEST(EstimatorStage, UsesNothingOfASetInDegrees) {
  std::vector<RecordingEstimator::Step> steps;
  EstimatorStage stage(std::make_unique<RecordingEstimator>(steps), Rig{}, StageSettings{0.5});
  stage.add(OdometryReading{.stamp = at_s(0.0), .sequence = 0, .T_odom_body = {}});
  BearingSet set = set_of(0.0, {.azimuth_rad = 100.0});
  set.bearings.push_back({.azimuth_rad = 1.0});
  stage.add(set);
  Estimate estimate;
  ASSERT_TRUE(stage.advance(estimate));
  EXPECT_EQ(estimate.input.values_not_finite, 2U);
  ASSERT_EQ(steps.size(), 1U);
}

}  // namespace
}  // namespace azimuth
