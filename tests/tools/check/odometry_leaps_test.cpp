// Tests the search for leaps in the odometry, and for steps that resemble leaps but are none.

#include "tools/check/odometry_leaps.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace azimuth {
namespace {

using Readings = std::vector<OdometryReading>;

OdometryReading reading(double t_s, double x_m, double y_m = 0.0) {
  return {.stamp = Stamp{duration_from_seconds(t_s)}, .T_odom_body = {x_m, y_m, 0.0}};
}

/// Readings of a straight drive at 0.3 m/s, ten per second.
Readings straight(int count) {
  Readings readings;
  for (int i = 0; i < count; ++i) readings.push_back(reading(0.1 * i, 0.03 * i));
  return readings;
}

TEST(OdometryLeaps, AreNoneInADrive) { EXPECT_FALSE(odometry_leaps(straight(200)).is_any()); }

TEST(OdometryLeaps, AreWhereCountsWrap) {
  // GIVEN wheels of 0.1 m radius whose angle wraps to [-pi, pi]
  Readings readings = straight(190);
  for (OdometryReading& each : readings)
    each.T_odom_body.x_m = 0.1 * std::remainder(each.T_odom_body.x_m / 0.1, 2 * kPi);
  const OdometryLeaps leaps = odometry_leaps(readings);
  EXPECT_EQ(leaps.leaps, 9u);
  EXPECT_FALSE(leaps.are_two_senders());
  EXPECT_NEAR(leaps.typical_m, 0.1 * 2 * kPi - 0.03, 1e-6);
}

TEST(OdometryLeaps, AreUndoneWhereTwoSend) {
  for (const int every : {1, 2, 5}) {  // the second sender sends one reading per `every` readings of the first
    Readings both;
    for (int i = 0; i < 200; ++i) {
      both.push_back(reading(0.1 * i, 0.03 * i));
      if (i % every == 0) both.push_back(reading(0.1 * i + 0.04, 0.03 * i + 0.25, 0.12));
    }
    const OdometryLeaps leaps = odometry_leaps(both);
    EXPECT_TRUE(leaps.are_two_senders()) << every;
    EXPECT_NEAR(leaps.typical_m, 0.27, 0.03) << every;
  }
}

TEST(OdometryLeaps, ToTheOriginAreAnOdometerThatBeginsAnew) {
  Readings readings = straight(200);
  for (std::size_t i = 100; i < 200; ++i) readings[i].T_odom_body.x_m -= readings[100].T_odom_body.x_m;
  readings[100].T_odom_body.x_m = 0.0;
  for (std::size_t i = 101; i < 200; ++i) readings[i].T_odom_body.x_m = 0.03 * static_cast<double>(i - 100);
  const OdometryLeaps leaps = odometry_leaps(readings);
  EXPECT_EQ(leaps.leaps, 1u);
  EXPECT_EQ(leaps.to_origin, 1u);
}

TEST(OdometryLeaps, AreNotSprintsNorStopsNorGapsNorStampsThatJitter) {
  Readings sprint;
  double x_m = 0.0;
  for (int i = 0; i < 300; ++i) {
    x_m += i < 200 ? 0.005 : (i < 230 ? 0.1 : 0.0);  // creeps, drives at 1 m/s, stops
    sprint.push_back(reading(0.1 * i, x_m));
  }
  EXPECT_FALSE(odometry_leaps(sprint).is_any());
  Readings gap = straight(200);
  gap.erase(gap.begin() + 50, gap.begin() + 90);
  EXPECT_FALSE(odometry_leaps(gap).is_any());
  Readings jitter = straight(200);
  for (std::size_t i = 1; i < jitter.size(); i += 2) jitter[i].stamp += duration_from_seconds(0.095);
  EXPECT_FALSE(odometry_leaps(jitter).is_any());
}

TEST(OdometryLeaps, AreNotTheStepsOfARobotThatReportsOnceASecond) {
  Readings slow;
  for (int i = 0; i < 40; ++i) slow.push_back(reading(i, i < 20 ? i : i + 5.0));  // one step of 6 m
  EXPECT_FALSE(odometry_leaps(slow).is_any());
}

}  // namespace
}  // namespace azimuth
