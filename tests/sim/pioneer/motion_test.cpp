// Position commands and their limits, as existing clients rely on them.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/sim/pioneer/plain_client.hpp"

namespace azimuth::sim {
namespace {

using pioneer::Command;
using pioneer::encode_command;

constexpr double kGoal_mm = 10.0, kGoal_deg = 1.0;  // tolerances of position commands

double heading_deg(const Received& sip) { return sip_heading(sip) * 360.0 / 4096; }
double turned_deg(double to, double from) { return rad_to_degrees(wrap(degrees_to_rad(to - from))); }

/// A client that drives: in a session, with motors on and PULSE twice a second.
class Motion : public testing::Test {
 public:
  void SetUp() override {
    client.open_quietly();
    order(Command::enable, 1);
  }

  void order(Command command, int argument) { client.ask(encode_command(command, argument), 10ms); }
  void order(Command command) { client.ask(encode_command(command), 10ms); }

  /// Waits for `duration` and keeps the watchdog quiet.
  void wait(Duration duration) {
    for (const Stamp end = client.now + duration; client.now < end;) {
      client.ask(encode_command(Command::pulse), std::min<Duration>(end - client.now, 500ms));
    }
  }
  /// Waits until the robot stands and returns the time in seconds, to one cycle.
  double seconds_to_rest() {
    const Stamp begin = client.now;
    wait(300ms);
    while (moving() && client.now < begin + 60s) wait(100ms);
    return to_seconds(client.now - begin);
  }

  Received newest_sip() { return client.sips(200ms).back(); }
  bool moving() const { return pioneer.firmware().driven().value_or(Twist{}) != Twist{}; }
  double x_mm() { return static_cast<std::int16_t>(sip_x(newest_sip())); }
  double heading() { return heading_deg(newest_sip()); }
  double speed() const { return pioneer.firmware().driven()->speed_m_per_s; }
  double turn_rate_deg() const { return rad_to_degrees(pioneer.firmware().driven()->turn_rate_rad_per_s); }

  SteadyChassis chassis{0.0, 0.0};
  SimulatedPioneer pioneer{PioneerModel{}, chassis, 1};
  PlainClient client{pioneer};
};

TEST_F(Motion, MoveGoesItsDistanceEitherWay) {
  double expected_mm = 0.0;
  for (const int distance_mm : {1000, -1000, 5000, 30, -2500, 7, 12000}) {
    order(Command::move, distance_mm);
    expected_mm += distance_mm;
    seconds_to_rest();
    EXPECT_NEAR(x_mm(), expected_mm, 1.5) << distance_mm;  // within kGoal_mm plus rounding
    EXPECT_NEAR(heading(), 0.0, 0.1);
  }
  static_assert(kGoal_mm > 1.5);
}

TEST_F(Motion, MoveHasATrapezoidalProfile) {
  order(Command::set_max_velocity, 400);
  order(Command::set_acceleration, 200);
  order(Command::set_acceleration, -100);
  order(Command::move, 3000);
  std::vector<double> speeds;
  for (int i = 0; i < 600; ++i) {  // every 25 ms
    client.listen(25ms);
    if (i % 20 == 0) client.send(encode_command(Command::pulse));
    speeds.push_back(1000.0 * speed());
  }
  EXPECT_NEAR(*std::ranges::max_element(speeds), 400.0, 1e-6);
  for (std::size_t i = 1; i < speeds.size(); ++i) {
    EXPECT_LE(speeds[i] - speeds[i - 1], 200 * 0.025 + 1e-9);
    EXPECT_GE(speeds[i] - speeds[i - 1], -100 * 0.025 - 1e-9);
  }
  const auto driving = std::ranges::count_if(speeds, [](double speed) { return std::abs(speed) > 1.0; });
  EXPECT_NEAR(0.025 * static_cast<double>(driving), 3000.0 / 400 + 400.0 / 200 / 2 + 400.0 / 100 / 2, 0.3);
}

TEST_F(Motion, HeadTurnsToAnAbsoluteHeadingTheShortWay) {
  double before = 0.0;
  for (const int goal_deg : {90, 170, -170, 190, -45, 359, 0}) {
    order(Command::heading, goal_deg);
    const bool counter_clockwise = turned_deg(goal_deg, before) > 0;
    wait(200ms);
    EXPECT_EQ(turn_rate_deg() > 0, counter_clockwise) << goal_deg;
    seconds_to_rest();
    EXPECT_NEAR(turned_deg(heading(), goal_deg), 0.0, 0.2) << goal_deg;  // within kGoal_deg
    before = goal_deg;
  }
  static_assert(kGoal_deg > 0.2);
}

TEST_F(Motion, HeadCountsFromTheOrigin) {
  order(Command::heading, 60);
  seconds_to_rest();
  order(Command::set_origin);
  EXPECT_NEAR(heading(), 0.0, 0.1);
  order(Command::heading, 60);
  seconds_to_rest();
  EXPECT_NEAR(heading(), 60.0, 0.2);
}

TEST_F(Motion, RelativeHeadingsCountFromWhereTheRobotFaces) {
  double expected_deg = 0.0;
  for (const int turn_deg : {30, -100, 179, 270, 5}) {
    order(Command::relative_heading, turn_deg);
    expected_deg += turn_deg;
    seconds_to_rest();
    EXPECT_NEAR(turned_deg(heading(), expected_deg), 0.0, 0.3) << turn_deg;
  }
}

TEST_F(Motion, RelativeToTheSetPointAddsUpWhileItTurns) {
  order(Command::heading, 40);
  wait(500ms);
  order(Command::heading_from_set_point, 30);
  wait(300ms);
  const Received turning = newest_sip();
  EXPECT_NEAR(i16(turning.data, 14) * 360.0 / 4096, 70.0, 0.5) << "CONTROL is the set-point";
  EXPECT_LT(heading_deg(turning), 60.0);
  seconds_to_rest();
  EXPECT_NEAR(heading(), 70.0, 0.2);
}

TEST_F(Motion, HeadAndSpeedGoTogether) {
  order(Command::velocity, 200);
  order(Command::heading, 90);
  wait(5s);
  EXPECT_NEAR(heading(), 90.0, 0.2);
  EXPECT_NEAR(speed(), 0.2, 1e-9);
}

TEST_F(Motion, ASpeedTakesThePlaceOfAWay) {
  order(Command::move, 5000);
  order(Command::heading, 170);
  wait(1s);
  order(Command::velocity, 100);
  wait(1500ms);
  EXPECT_NEAR(speed(), 0.1, 1e-9);
  EXPECT_GT(turn_rate_deg(), 5.0) << "the turn goes on";
  order(Command::rotation, -10);
  wait(2s);
  EXPECT_NEAR(turn_rate_deg(), -10.0, 1e-9);
  EXPECT_NEAR(speed(), 0.1, 1e-9);
}

TEST_F(Motion, WheelSpeedsTakeThePlaceOfBothAndGiveWayToEither) {
  order(Command::move, 5000);
  order(Command::heading, 170);
  order(Command::wheel_velocities, (10 << 8) | 15);
  wait(3s);
  EXPECT_NEAR(speed(), 0.25, 1e-9);
  EXPECT_NEAR(degrees_to_rad(turn_rate_deg()), 0.1 / chassis.track_m, 1e-9);
  order(Command::velocity, 100);
  wait(3s);
  EXPECT_NEAR(speed(), 0.1, 1e-9);
  EXPECT_EQ(turn_rate_deg(), 0.0);
}

TEST_F(Motion, StopEndsAWay) {
  order(Command::move, 5000);
  order(Command::heading, 90);
  wait(1s);
  order(Command::stop);
  EXPECT_LT(seconds_to_rest(), 2.5);
  wait(2s);
  EXPECT_FALSE(moving());
  EXPECT_LT(x_mm(), 1000.0);
}

TEST_F(Motion, EmergencyStopIsAtOnceAndUntilTheNextOrder) {
  order(Command::velocity, 500);
  wait(2s);
  order(Command::emergency_stop);
  EXPECT_FALSE(moving());
  EXPECT_NE(u16(newest_sip().data, 16) & 0x20, 0);
  order(Command::move, 300);
  wait(500ms);
  EXPECT_TRUE(moving());
  EXPECT_EQ(u16(newest_sip().data, 16) & 0x20, 0);
}

TEST_F(Motion, TheWatchdogPausesAWay) {
  order(Command::move, 5000);
  wait(1s);
  client.listen(6s);  // without any command
  EXPECT_FALSE(moving());
  EXPECT_LT(x_mm(), 4000.0);
  seconds_to_rest();
  EXPECT_NEAR(x_mm(), 5000.0, 1.5);
}

TEST_F(Motion, NothingMovesWithTheMotorsOff) {
  order(Command::enable, 0);
  order(Command::move, 1000);
  order(Command::heading, 90);
  wait(2s);
  EXPECT_FALSE(moving());
  order(Command::enable, 1);
  wait(2s);
  EXPECT_FALSE(moving()) << "what was ordered then was not heard";
}

TEST_F(Motion, LimitsHoldForLaterOrdersAndForThisSession) {
  order(Command::velocity, 800);
  wait(3s);
  order(Command::set_max_velocity, 300);
  wait(1s);
  EXPECT_NEAR(speed(), 0.8, 1e-9) << "on its way already";
  order(Command::velocity, 800);
  wait(3s);
  EXPECT_NEAR(speed(), 0.3, 1e-9);
  order(Command::set_max_rotation, 20);
  order(Command::rotation, 90);
  wait(3s);
  EXPECT_NEAR(turn_rate_deg(), 20.0, 1e-9);
  order(Command::close);
  client.listen(200ms);
  client.open_quietly();
  order(Command::enable, 1);
  order(Command::velocity, 5000);
  wait(5s);
  EXPECT_NEAR(speed(), 1.0, 1e-9) << "never beyond the robot's own";
}

TEST_F(Motion, ConfigurationTellsThePresentLimits) {
  order(Command::set_max_velocity, 456);
  order(Command::set_rotation_acceleration, 77);
  order(Command::set_rotation_acceleration, -66);
  order(Command::set_acceleration, 30000);
  auto packets = client.ask(encode_command(Command::config), 400ms);
  std::erase_if(packets, is_sip);
  ASSERT_EQ(packets.size(), 1U);
  const Bytes& data = packets.front().data;
  const std::size_t limits = 1 + 8 + 8 + 9 + 1 + 10 + 12 + 3 + 5 + 6 + 1 + 8;  // offset after joyRotVel
  EXPECT_EQ(u16(data, limits), 360);
  EXPECT_EQ(u16(data, limits + 2), 456);
  EXPECT_EQ(u16(data, limits + 4), 77);
  EXPECT_EQ(u16(data, limits + 6), 66);
  EXPECT_EQ(u16(data, limits + 14), 2000) << "transAcc: the robot's own";
  EXPECT_EQ(u16(data, limits + 16), 300);
}

}  // namespace
}  // namespace azimuth::sim
