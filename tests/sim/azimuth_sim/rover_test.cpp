#include "sim/azimuth_sim/rover.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sim/world/simulate.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth::sim {
namespace {

constexpr double kTrack_m = 2.0 / 5.6;

Stamp at_s(double seconds) { return Stamp(duration_from_seconds(seconds)); }

void expect_near(const Pose2& a, const Pose2& b, double tolerance_m, double tolerance_rad) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance_m);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance_m);
  EXPECT_NEAR(wrap(a.heading_rad - b.heading_rad), 0.0, tolerance_rad);
}

class RoverOnEveryPath : public testing::TestWithParam<std::string_view> {};

// The rover drives exactly as in the recorded run of the same scenario.
TEST_P(RoverOnEveryPath, DrivesAsSimulateDoes) {
  const Scenario scenario = *scenario_named(GetParam(), 3, 1);
  const World world = simulate(scenario);
  Rover rover(scenario, kTrack_m);
  std::size_t odometry = 0;
  for (const TruePose& truth : world.truth) {
    for (; odometry < world.odometry.size() && world.odometry[odometry].stamp <= truth.stamp; ++odometry) {
      const OdometryReading& reading = world.odometry[odometry];
      expect_near(rover.pose_in_odom(reading.stamp), reading.T_odom_body, 2e-6, 2e-6);
    }
    expect_near(rover.pose_in_world(truth.stamp), truth.T_world_body, 2e-6, 2e-6);
  }
  EXPECT_GT(odometry, 100U);
}
INSTANTIATE_TEST_SUITE_P(Smooth, RoverOnEveryPath, testing::Values("lab", "hall", "corridor", "scattered"),
                         test::PrintedName());

TEST(Rover, StopsAndGoesOnItsWheels) {
  Scenario scenario = coloured_lab(1);
  Rover rover(scenario, kTrack_m);
  double driven_m = 0.0, largest_turn_rad = 0.0;
  for (int i = 1; i < 3600; ++i) {
    const WheelMotion motion = rover.roll_to(at_s(0.01 * i));
    driven_m += (motion.left_m + motion.right_m) / 2;
    largest_turn_rad = std::max(largest_turn_rad, std::abs(motion.right_m - motion.left_m) / kTrack_m);
    if (i % 100 == 0) {
      EXPECT_LT(distance_to_path(rover.pose_in_world(at_s(0.01 * i)).position(), scenario.path), 0.6);
    }
  }
  EXPECT_NEAR(driven_m, 36.0, 5.0);
  EXPECT_LT(largest_turn_rad, 0.15) << "turns are spread over ticks";
  EXPECT_FALSE(rover.arrived());
  rover.roll_to(at_s(36.5));
  EXPECT_TRUE(rover.arrived());
}

TEST(Rover, WheelsSumUpToItsOdometry) {
  const Scenario scenario = lab(2, 1);
  Rover rover(scenario, kTrack_m);
  double left_m = 0.0, right_m = 0.0, body_rad = 0.0;
  Pose2 before;
  double odometer_rad = 0.0;
  for (int i = 1; i <= 3000; ++i) {
    const Stamp now = at_s(0.025 * i);
    const WheelMotion motion = rover.roll_to(now);
    left_m += motion.left_m;
    right_m += motion.right_m;
    body_rad += motion.body_turn_rad;
    const Pose2 after = rover.pose_in_odom(now);
    odometer_rad += wrap(after.heading_rad - before.heading_rad);
    before = after;
  }
  EXPECT_NEAR((right_m - left_m) / kTrack_m, odometer_rad, 1e-6);
  EXPECT_NEAR(wrap(body_rad - rover.pose_in_world(at_s(75)).heading_rad), 0.0, 1e-6) << "it began along x";
}

TEST(Rover, StandsAtTheEndOfItsPath) {
  Rover rover(corridor(1, 1), kTrack_m);
  const Pose2 end = rover.pose_in_world(at_s(1000));
  EXPECT_TRUE(rover.arrived());
  EXPECT_EQ(rover.pose_in_world(at_s(1100)), end);
}

TEST(Rover, HurriesOnCommand) {
  Rover rover(corridor(1, 1), kTrack_m);
  rover.pose_in_world(at_s(5));
  rover.hurry(1.5);
  const double before_m = rover.pose_in_odom(at_s(6)).x_m;
  EXPECT_NEAR(rover.pose_in_odom(at_s(7)).x_m - before_m, 1.5, 0.05);
  rover.hurry(0.0);
  const double later_m = rover.pose_in_odom(at_s(8)).x_m;
  EXPECT_NEAR(rover.pose_in_odom(at_s(9)).x_m - later_m, 0.5, 0.05);
}

TEST(Rover, ObeysAClientAndThenFindsItsPathAgain) {
  const Scenario scenario = lab(4, 1);
  Rover rover(scenario, kTrack_m);
  const auto off_path_m = [&](double now_s) {
    return distance_to_path(rover.pose_in_world(at_s(now_s)).position(), scenario.path);
  };
  rover.pose_in_world(at_s(5));
  rover.drive(Twist{0.3, 0.1});
  const Pose2 start = rover.pose_in_odom(at_s(5.01)), end = rover.pose_in_odom(at_s(15.01));
  EXPECT_NEAR((end.position() - start.position()).norm(), 2 * 3.0 * std::sin(0.5), 0.1);  // an arc of one radian
  EXPECT_GT(off_path_m(15.01), 0.7);
  rover.drive(Twist{});
  const Pose2 held = rover.pose_in_world(at_s(16));
  EXPECT_EQ(rover.pose_in_world(at_s(20)), held);
  rover.drive(std::nullopt);
  double nearest_m = 10.0;
  for (double now_s = 20.0; now_s < 60.0; now_s += 0.1) nearest_m = std::min(nearest_m, off_path_m(now_s));
  EXPECT_LT(nearest_m, 0.05);
}

}  // namespace
}  // namespace azimuth::sim
