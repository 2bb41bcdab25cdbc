#include "slam/sample/odometry_steps.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// A drive along an arc at `speed_m_s` and 0.2 rad/s, with `rate_hz` readings per second.
std::vector<OdometryReading> arc(double seconds, double rate_hz = 10.0, double speed_m_s = 0.3) {
  std::vector<OdometryReading> readings;
  Pose2 pose;
  const double dt_s = 1.0 / rate_hz;
  for (int i = 0; i < static_cast<int>(seconds * rate_hz); ++i) {
    readings.push_back({.stamp = stamp_from_us(1'000'000 + std::llround(1e6 * i * dt_s)),
                        .sequence = readings.size(),
                        .T_odom_body = pose});
    pose = pose * Pose2{speed_m_s * dt_s, 0.0, 0.2 * dt_s};
  }
  return readings;
}

/// Makes the odometer count from zero again from reading `index` on.
void begin_anew(std::vector<OdometryReading>& readings, std::size_t index) {
  const Pose2 T_begin_odom = inverse(readings[index].T_odom_body);
  for (std::size_t i = index; i < readings.size(); ++i)
    readings[i].T_odom_body = T_begin_odom * readings[i].T_odom_body;
}

TEST(OdometrySteps, OfADriveAreAllOfWheels) {
  for (const double rate_hz : {1.0, 5.0, 20.0, 100.0})
    for (const double speed_m_s : {0.0, 0.05, 0.3, 2.0, 10.0}) {
      auto readings = arc(60.0, rate_hz, speed_m_s);
      EXPECT_TRUE(part_at_jumps(readings).empty()) << rate_hz << " Hz, " << speed_m_s << " m/s";
    }
}

TEST(OdometrySteps, WithStampsOfArrivalAreAllOfWheels) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> late_s(0.0, 0.25);
  auto readings = arc(120.0, 10.0, 1.0);
  Stamp last = Stamp::min();
  for (OdometryReading& reading : readings) {
    reading.stamp = std::max(reading.stamp + duration_from_seconds(late_s(random)), last + Duration{1000});
    last = reading.stamp;
  }
  EXPECT_TRUE(part_at_jumps(readings).empty());
}

TEST(OdometrySteps, BackToWhereADriveBeganAreOfWheels) {
  auto readings = arc(2.0 * kPi / 0.2 + 5.0);  // more than a full circle
  EXPECT_TRUE(part_at_jumps(readings).empty());
}

TEST(OdometrySteps, ToZeroAreAnOdometerThatBeginsAnew) {
  for (const double at_s : {2.0, 5.0, 15.0, 30.0}) {  // 0.6 to 3 m from zero
    auto readings = arc(40.0);
    const auto index = static_cast<std::size_t>(10.0 * at_s);
    const Pose2 before = readings[index - 1].T_odom_body;
    begin_anew(readings, index);
    const auto jumps = part_at_jumps(readings);
    ASSERT_EQ(jumps.size(), 1u) << at_s;
    EXPECT_EQ(jumps[0].stamp, readings[index].stamp);
    EXPECT_NEAR(jumps[0].step_m, before.position().norm(), 1e-9);
    EXPECT_EQ(readings[index - 1].origin, 0u);
    EXPECT_EQ(readings[index].origin, 1u);
    EXPECT_EQ(readings.back().origin, 1u);
    EXPECT_LT(readings[index].T_odom_body.position().norm(), 1e-12) << "as it was read";
    EXPECT_GE(readings[index].sigma_gap_m, 0.03) << "0.1 s at 0.3 m/s";
    EXPECT_LT(readings[index].sigma_gap_m, 0.06);
    EXPECT_GE(readings[index].sigma_gap_rad, 0.02);
    EXPECT_EQ(readings[index + 1].sigma_gap_m, 0.0);
  }
}

TEST(OdometrySteps, ToZeroAfterALongPauseLeaveTheWayUnknown) {
  auto readings = arc(40.0);
  begin_anew(readings, 200);
  for (std::size_t i = 200; i < readings.size(); ++i) readings[i].stamp += Duration{30'000'000};
  const auto jumps = part_at_jumps(readings);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_GT(readings[200].sigma_gap_m, 10.0);
  EXPECT_GT(readings[200].sigma_gap_rad, 3.0);
}

TEST(OdometrySteps, AcrossTheRoomAreOfNoWheel) {
  auto readings = arc(40.0);
  for (std::size_t i = 200; i < readings.size(); ++i)
    readings[i].T_odom_body = Pose2{2.0, -1.0, 0.0} * readings[i].T_odom_body;
  const auto jumps = part_at_jumps(readings);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_EQ(readings[200].origin, 1u);
}

TEST(OdometrySteps, ThatJumpAllTheTimeAreLeftAsTheyAre) {
  auto readings = arc(40.0);
  const auto before = readings;
  // readings of a second sender in between
  for (std::size_t i = 0; i < readings.size(); i += 12) readings[i].T_odom_body.x_m += 2.0;
  EXPECT_TRUE(part_at_jumps(readings).empty());
  OdometrySteps steps;
  for (const OdometryReading& reading : readings) {
    EXPECT_EQ(reading.origin, 0u);
    steps.next(reading);
  }
  EXPECT_TRUE(steps.are_frequent());
}

TEST(OdometrySteps, OfAnotherOriginAreNoJumps) {
  auto readings = arc(40.0);
  begin_anew(readings, 200);
  for (std::size_t i = 200; i < readings.size(); ++i) readings[i].origin = 7;
  OdometrySteps steps;
  for (const OdometryReading& reading : readings) EXPECT_FALSE(steps.next(reading));
}

}  // namespace
}  // namespace azimuth
