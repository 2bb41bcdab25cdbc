// Exact effects of single faults on the odometry.

#include <gmock/gmock.h>

#include "tests/robot/agreement.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::HasSubstr;

class LineTest : public testing::Test {
 public:
  DrivenRobot& robot() {
    if (!robot_) robot_.emplace(setup, chassis);
    return *robot_;
  }
  double driven_m() { return robot().sightings.back().reading.T_odom_body.x_m; }
  /// Path of the wheels from the first reading to the last.
  double wheels_m() { return robot().sightings.back().path_m - robot().sightings.front().path_m; }

  RobotSetup setup;
  EvenChassis chassis{{0.5, 0.0}};

 private:
  std::optional<DrivenRobot> robot_;
};

TEST_F(LineTest, KeepsTheDistanceOfLostSipsAtFullSpeed) {
  for (const PioneerFeature encoder : {PioneerFeature::off, PioneerFeature::automatic}) {
    setup.settings.encoder = encoder;
    EvenChassis fast{{1.5, 0.0}};
    DrivenRobot robot(setup, fast);
    robot.fault("lose_sips=0.2");
    robot.run(120s);  // beyond the wraps of 15 and 16 bits
    const Sighting &first = robot.sightings.front(), &last = robot.sightings.back();
    EXPECT_GT(last.path_m, 170.0);
    EXPECT_NEAR(last.reading.T_odom_body.x_m, last.path_m - first.path_m, kUnit_m);
    EXPECT_EQ(last.reading.origin, first.reading.origin);
    EXPECT_NEAR(static_cast<double>(robot.pioneer().counts().lost_sips), 240.0, 60.0);
    EXPECT_EQ(robot.state().uses_ticks, encoder == PioneerFeature::automatic);
  }
}

class WrapTest : public LineTest, public testing::WithParamInterface<std::tuple<std::string, double>> {};

TEST_P(WrapTest, IsCrossedForwardsAndBackwards) {
  const auto [fault, speed] = GetParam();
  chassis.twist.speed_m_per_s = speed;
  setup.settings.encoder = PioneerFeature::off;
  robot().fault(fault);
  robot().run(20s);
  EXPECT_NEAR(driven_m(), std::copysign(wheels_m(), speed), kUnit_m);
  EXPECT_GT(wheels_m(), 9.0);
  EXPECT_EQ(robot().state().gaps, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, WrapTest,
                         testing::Combine(testing::Values("wrap15=32700", "wrap15=60", "wrap16=65500", "wrap16=32700",
                                                          "wrap16=60"),
                                          testing::Values(0.6, -0.6)),
                         PrintedName());

TEST_F(LineTest, HeadingCrossesItsWrapBothWays) {
  for (const double turn_rate : {0.8, -0.8}) {
    EvenChassis spin{{0.1, turn_rate}};
    DrivenRobot robot(setup, spin);
    robot.fault("heading=175");
    robot.run(60s);
    expect_agreement(robot.sightings, 0.002);
    EXPECT_EQ(robot.state().gaps, 0U);
    double turned_rad = 0.0;
    for (std::size_t i = 1; i < robot.sightings.size(); ++i)
      turned_rad += wrap(robot.sightings[i].reading.T_odom_body.heading_rad -
                         robot.sightings[i - 1].reading.T_odom_body.heading_rad);
    const double passed_s = to_seconds(robot.sightings.back().latched_at - robot.sightings.front().latched_at);
    EXPECT_NEAR(turned_rad, turn_rate * passed_s, 1.01 * kHeadingUnit_rad) << "whole turns included";
  }
}

TEST_F(LineTest, BelievesAConfigWithAWrongChecksumAndSaysSo) {
  robot().fault("bad_config_checksum");
  robot().run(10s);
  EXPECT_TRUE(robot().state().config_unverified);
  EXPECT_EQ(robot().state().firmware, setup.model.firmware_version);
  EXPECT_EQ(robot().state().baud, 115200) << "as its parameters allow";
  EXPECT_TRUE(robot().state().uses_ticks);
  EXPECT_THAT(robot().events, Contains(HasSubstr("wrong checksum")));
}

TEST_F(LineTest, AcceptsThatTheRobotRefusesAHigherRate) {
  robot().fault("hostbaud=refused");
  robot().run(20s);
  EXPECT_EQ(robot().state().connection, Connection::running);
  EXPECT_EQ(robot().state().baud, 9600);
  EXPECT_EQ(robot().state().sessions, 1U);
  EXPECT_THAT(robot().events, Contains(HasSubstr("higher baud rate")));
  EXPECT_NEAR(driven_m(), wheels_m(), kUnit_m);
}

class OldSessionTest : public LineTest, public testing::WithParamInterface<int> {};

TEST_P(OldSessionTest, IsEndedAtWhateverRateItHas) {
  robot().fault("old_session=" + std::to_string(GetParam()));
  robot().run(8s);
  EXPECT_EQ(robot().state().connection, Connection::running);
  EXPECT_EQ(robot().state().baud, 115200);
  EXPECT_EQ(robot().state().sessions, 1U);
  ASSERT_FALSE(robot().sightings.empty());
  EXPECT_LT(to_seconds(robot().sightings.front().taken_at), 5.0);
  EXPECT_NEAR(driven_m(), wheels_m(), kUnit_m);
}

INSTANTIATE_TEST_SUITE_P(All, OldSessionTest, testing::Values(9600, 19200, 38400, 57600, 115200), PrintedName());

class OutageTest : public LineTest, public testing::WithParamInterface<std::string> {};

/// After a restart of the controller the motion in between is missing, and the driver states how large it may be.
TEST_P(OutageTest, BeginsANewOriginAndCoversTheMotionMissed) {
  robot().run(10s);
  const Sighting before = robot().sightings.back();
  robot().fault(GetParam());
  const Stamp fault_at = robot().now();
  while (robot().sightings.back().reading.origin == before.reading.origin && robot().now() < fault_at + 10s)
    ASSERT_TRUE(robot().run_to_reading(10s));
  const Sighting last_old = robot().sightings[robot().sightings.size() - 2];
  const Sighting first_new = robot().sightings.back();
  ASSERT_EQ(first_new.reading.origin, before.reading.origin + 1);
  EXPECT_EQ(first_new.reading.T_odom_body, Pose2{});
  const double missed_m = first_new.path_m - last_old.path_m;
  EXPECT_GT(missed_m, 0.1);
  EXPECT_GE(first_new.reading.sigma_gap_m, missed_m);
  EXPECT_LE(first_new.reading.sigma_gap_m, 1.2 * missed_m + 0.1) << "and not much more";
  robot().run(10s);
  EXPECT_EQ(robot().state().sessions, 2U);
  expect_agreement(robot().sightings);
}

INSTANTIATE_TEST_SUITE_P(All, OutageTest, testing::Values("reboot=0xFF", "reboot=0xFE"), PrintedName());

class ShortOutageTest : public LineTest, public testing::WithParamInterface<std::string> {};

/// The controller continues to count while its cable is unplugged.
TEST_P(ShortOutageTest, LosesNoMotion) {
  robot().run(10s);
  const Sighting before = robot().sightings.back();
  robot().fault(GetParam());
  robot().run(15s);
  EXPECT_GT(robot().sightings.back().path_m - before.path_m, 0.5);
  EXPECT_EQ(robot().sightings.back().reading.origin, before.reading.origin);
  EXPECT_EQ(robot().state().sessions, 1U);
  EXPECT_EQ(robot().state().resumed, 1U);
  expect_agreement(robot().sightings);
}

INSTANTIATE_TEST_SUITE_P(All, ShortOutageTest, testing::Values("unplug=1", "unplug=3"), PrintedName());

TEST_F(LineTest, NoticesRestartsByEitherId) {
  robot().run(10s);
  robot().fault("reboot=0xFF");
  robot().run(10s);
  robot().fault("reboot=0xFE");
  robot().run(10s);
  EXPECT_EQ(robot().state().reboots, 2U);
  EXPECT_EQ(robot().state().sessions, 3U);
  EXPECT_EQ(robot().state().connection, Connection::running);
}

/// A silence shorter than the connection's timeout loses no distance; the driver adds a small uncertainty.
TEST_F(LineTest, SilenceWithinTheSessionLosesNoDistance) {
  robot().run(10s);
  const Sighting before = robot().sightings.back();
  robot().fault("silence=1.2");
  robot().run(1s);
  EXPECT_EQ(robot().state().connection, Connection::silent);
  robot().run(10s);
  EXPECT_EQ(robot().state().stale, 1U);
  EXPECT_EQ(robot().state().sessions, 1U);
  EXPECT_EQ(robot().state().gaps, 1U);
  EXPECT_EQ(robot().sightings.back().reading.origin, before.reading.origin);
  EXPECT_NEAR(driven_m(), wheels_m(), kUnit_m);
}

TEST_F(LineTest, KeepsTheWatchdogQuiet) {
  robot().fault("watchdog=700");
  robot().run(60s);
  EXPECT_FALSE(chassis.held);
  EXPECT_GT(wheels_m(), 28.0);
}

TEST_F(LineTest, ShowsStallsAndBumpers) {
  robot().run(5s);
  EXPECT_FALSE(robot().state().left_stall || robot().state().right_stall);
  robot().fault("stall=right");
  robot().fault("bumpers=rear");
  robot().run(1s);
  EXPECT_FALSE(robot().state().left_stall);
  EXPECT_TRUE(robot().state().right_stall);
  EXPECT_NE(robot().state().bumpers.rear, 0);
  EXPECT_EQ(robot().state().bumpers.front, 0);
}

TEST_F(LineTest, UsesTheAnalogGyroOfARobotThatHasOne) {
  setup.model.has_gyro = true;
  chassis.twist = {};
  robot().run(10s);  // the driver learns the gyro's rate at rest
  EXPECT_TRUE(robot().state().uses_gyro);
  chassis.twist = {0.3, 0.4};
  robot().run(60s);
  const Agreement found = agreement(robot().sightings);
  RecordProperty("worst_rad", std::to_string(found.worst_rad));
  EXPECT_LT(found.worst_rad, 0.25) << "of 24 rad: a gyro of one per cent, but its wheels do not slip here";
  EXPECT_EQ(robot().state().gaps, 0U);
}

/// With 1 of 500 bytes damaged, the affected packets are lost, but no motion.
TEST_F(LineTest, NoiseCostsPacketsAndNoMotion) {
  robot().run(5s);
  robot().fault("noise=0.002");
  robot().run(300s);
  robot().fault("noise=0");
  robot().run(2s);
  EXPECT_GT(robot().state().bad_checksums, 100U);
  EXPECT_EQ(robot().state().sessions, 1U);
  EXPECT_GT(robot().sightings.size(), 2600U);
  EXPECT_NEAR(driven_m(), wheels_m(), kUnit_m);
}

/// With this much noise a damaged packet sometimes has a valid checksum. The next good packet corrects the forged
/// motion to within centimetres; until then the driver reports uncertainty, unless the motion is physically possible.
TEST_F(LineTest, WhatNoiseForgesIsDoubtedAndDoesNotStay) {
  constexpr double kForged_m = 0.5, kImpossible_m = 1.0;
  chassis.twist = {0.4, 0.1};
  robot().run(5s);
  robot().fault("noise=0.015");
  robot().run(3h);
  robot().fault("noise=0");
  robot().run(20s);
  std::size_t forged = 0, in_a_row = 0;
  const Sighting* first = nullptr;
  for (const Sighting& sighting : robot().sightings) {
    if (first == nullptr || sighting.reading.origin != first->reading.origin) first = &sighting;
    const double error_m = error_since(*first, sighting).position().norm();
    in_a_row = error_m > kForged_m ? in_a_row + 1 : 0;
    forged += error_m > kForged_m;
    EXPECT_LE(in_a_row, 1U) << "at " << to_seconds(sighting.taken_at) << " s";
    if (error_m > kImpossible_m) {
      EXPECT_GT(sighting.reading.sigma_gap_m, 0.5 * error_m);
    }
  }
  EXPECT_GT(forged, 0U) << "else this test shows nothing";
  EXPECT_LT(forged, 20U);
  EXPECT_EQ(robot().sightings.back().reading.origin, robot().sightings.front().reading.origin);
  EXPECT_EQ(robot().state().connection, Connection::running);
}

TEST_F(LineTest, SonarTrafficLeavesRoomForOdometryAt9600) {
  setup.settings.raised_baud = 0;
  setup.settings.encoder = PioneerFeature::off;
  robot().fault("sonar");
  robot().run(60s);
  EXPECT_EQ(robot().state().baud, 9600);
  EXPECT_GT(robot().sightings.size(), 570U);
  EXPECT_EQ(robot().state().bad_checksums, 0U);
  EXPECT_NEAR(driven_m(), wheels_m(), kUnit_m);
}

}  // namespace
}  // namespace azimuth::test
