#include <gtest/gtest.h>

#include "slam/geometry/motion.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

TEST(Control, DrivenAgainReachesTheSamePose) {
  RandomDraws draws(21);
  for (int i = 0; i < 500; ++i) {
    const Pose2 start = draws.pose(5.0), end = draws.pose(5.0);
    for (const bool reverse_driving : {false, true}) {
      const Control control = control_between(start, end, reverse_driving);
      const Pose2 reached = move(start, control);
      EXPECT_LT((reached.position() - end.position()).norm(), 1e-12);
      EXPECT_NEAR(wrap(reached.heading_rad - end.heading_rad), 0.0, 1e-12);
      if (reverse_driving) {
        EXPECT_LE(std::abs(control.first_turn_rad), kPi / 2.0);
      }
    }
  }
}

TEST(Control, AnglesAreWrapped) {
  RandomDraws draws(22);
  for (int i = 0; i < 500; ++i) {
    const Control control = control_between(draws.pose(5.0), draws.pose(5.0), draws.chance(0.5));
    for (const double turn_rad : {control.first_turn_rad, control.second_turn_rad}) {
      EXPECT_GE(turn_rad, -kPi);
      EXPECT_LT(turn_rad, kPi);
    }
  }
}

TEST(Control, DrivingStraightBackTurnsNowhere) {
  const Pose2 start{1.0, 2.0, 2.5};
  const Control control = control_between(start, start * Pose2{-0.8, 0.0, 0.0});
  EXPECT_NEAR(control.distance_m, -0.8, 1e-12);
  EXPECT_NEAR(control.first_turn_rad, 0.0, 1e-12);
  EXPECT_NEAR(control.second_turn_rad, 0.0, 1e-12);
}

TEST(Control, BelowATenthOfAMillimetreIsATurnOnTheSpot) {
  const Control control = control_between({0.0, 0.0, 3.0}, {-0.9e-4, 0.0, -3.0});
  EXPECT_EQ(control.distance_m, 0.0);
  EXPECT_EQ(control.first_turn_rad, 0.0);
  EXPECT_NEAR(control.second_turn_rad, 2.0 * kPi - 6.0, 1e-12);
  EXPECT_NE(control_between({}, {1.1e-4, 0.0, 0.0}).distance_m, 0.0);
}

TEST(Control, DriftAndTurnsAreChargedByMagnitude) {
  MotionNoise noise;
  noise.lambda_distance_m = 2.0;
  noise.lambda_rotation_rad = 3.0;
  noise.lambda_drift_rad2_per_m = 5.0;
  EXPECT_EQ(control_variances({-0.5, -0.25, 0.125}, noise), Eigen::Vector4d(1.0, 0.75, 0.375, 2.5));
}

}  // namespace
}  // namespace azimuth
