#include "sim/world/simulate.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

bool same(const World& a, const World& b) {
  if (a.odometry != b.odometry || a.truth != b.truth || a.bearings.size() != b.bearings.size()) return false;
  for (std::size_t i = 0; i < a.bearings.size(); ++i) {
    const BearingSet &left = a.bearings[i], &right = b.bearings[i];
    if (left.stamp != right.stamp || left.sequence != right.sequence) return false;
    if (!std::equal(left.bearings.begin(), left.bearings.end(), right.bearings.begin(), right.bearings.end(),
                    [](const Bearing& x, const Bearing& y) {
                      return x.azimuth_rad == y.azimuth_rad && x.identity == y.identity;
                    }))
      return false;
  }
  return true;
}

class EveryScenario : public testing::TestWithParam<std::string_view> {
 protected:
  Scenario scenario(std::uint64_t seed) const { return *scenario_named(GetParam(), seed); }
};

TEST_P(EveryScenario, IsDeterministicAndDependsOnItsSeed) {
  EXPECT_TRUE(same(simulate(scenario(1)), simulate(scenario(1))));
  EXPECT_FALSE(same(simulate(scenario(1)), simulate(scenario(2))));
}

TEST_P(EveryScenario, SamplesAreInOrderAndNumbered) {
  const World world = simulate(scenario(3));
  ASSERT_FALSE(world.bearings.empty());
  for (std::size_t i = 0; i < world.odometry.size(); ++i) {
    EXPECT_EQ(world.odometry[i].sequence, i);
    if (i > 0) {
      EXPECT_LT(world.odometry[i - 1].stamp, world.odometry[i].stamp);
    }
  }
  for (std::size_t i = 0; i < world.bearings.size(); ++i) {
    EXPECT_EQ(world.bearings[i].sequence, i);
    if (i > 0) {
      EXPECT_LT(world.bearings[i - 1].stamp, world.bearings[i].stamp);
    }
  }
  EXPECT_EQ(world.odometry.front().T_odom_body, Pose2{});
  EXPECT_LE(world.bearings.back().stamp, world.odometry.back().stamp);
  EXPECT_EQ(world.truth.back().stamp, world.odometry.back().stamp);
}

TEST_P(EveryScenario, AnglesStayInRange) {
  const World world = simulate(scenario(4));
  const auto in_range = [](double angle_rad) { return angle_rad >= -kPi && angle_rad < kPi; };
  for (const TruePose& pose : world.truth) EXPECT_TRUE(in_range(pose.T_world_body.heading_rad));
  for (const OdometryReading& reading : world.odometry) EXPECT_TRUE(in_range(reading.T_odom_body.heading_rad));
  for (const BearingSet& set : world.bearings)
    for (const Bearing& bearing : set.bearings) EXPECT_TRUE(in_range(bearing.azimuth_rad));
}

TEST_P(EveryScenario, ShowsEnoughLandmarksToLocaliseBy) {
  const World world = simulate(scenario(5));
  std::size_t bearings = 0;
  for (const BearingSet& set : world.bearings) bearings += set.bearings.size();
  EXPECT_GE(static_cast<double>(bearings) / static_cast<double>(world.bearings.size()), 3.0);
}

double driven_m(const World& world) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < world.truth.size(); ++i)
    sum_m += (world.truth[i].T_world_body.position() - world.truth[i - 1].T_world_body.position()).norm();
  return sum_m;
}

TEST_P(EveryScenario, IsDrivenRoundAsOftenAsIsAskedFor) {
  const double one_m = driven_m(simulate(*scenario_named(GetParam(), 6, 1)));
  const double two_m = driven_m(simulate(*scenario_named(GetParam(), 6, 2)));
  const double five_m = driven_m(simulate(*scenario_named(GetParam(), 6, 5)));
  EXPECT_GT(two_m, 1.6 * one_m);
  EXPECT_NEAR(five_m / one_m, 5.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(All, EveryScenario, testing::ValuesIn(kScenarioNames), [](const auto& tested) {
  std::string name(tested.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Simulate, KnowsNoOtherScenario) { EXPECT_FALSE(scenario_named("moon", 1)); }

TEST(Simulate, ColouredLabIsTheWorldOfTheSpecification) {
  const Scenario scenario = coloured_lab(1);
  const World world = simulate(scenario);
  EXPECT_EQ(scenario.landmarks.size(), 24u);
  EXPECT_EQ(world.odometry.size(), 37u);
  EXPECT_EQ(world.bearings.size(), 37u);
  EXPECT_EQ(world.truth.size(), 37u);
  EXPECT_NEAR(scenario.sensor.sigma_bearing_rad, degrees_to_rad(1.5), 1e-9);
}

TEST(Simulate, LabRunsAtTheRatesOfARobot) {
  const World world = simulate(lab(1));
  const double duration_s = to_seconds(world.odometry.back().stamp);
  EXPECT_NEAR(static_cast<double>(world.odometry.size()) / duration_s, 10.0, 0.1);
  EXPECT_NEAR(static_cast<double>(world.bearings.size()) / duration_s, 5.0, 0.1);
  EXPECT_NEAR(to_seconds(world.bearings.front().stamp), 0.03, 1e-9);
  double length_m = 0.0;
  for (std::size_t i = 1; i < world.odometry.size(); ++i)
    length_m += (world.odometry[i].T_odom_body.position() - world.odometry[i - 1].T_odom_body.position()).norm();
  EXPECT_NEAR(length_m, 3 * 32.0, 4.0);
}

TEST(Simulate, ChangingOneSensorLeavesTheOthersAlone) {
  Scenario scenario = lab(1, 1);
  const World before = simulate(scenario);
  scenario.sensor.clutter_per_set = 1.0;
  const World after = simulate(scenario);
  EXPECT_EQ(before.odometry, after.odometry);
  EXPECT_EQ(before.truth, after.truth);
  EXPECT_FALSE(same(before, after));
}

TEST(Simulate, WithoutNoiseOdometryIsTheTruth) {
  Scenario scenario = lab(1, 1);
  scenario.odometer = OdometerSettings{0.0, 0.0, 0.0, 0.0};
  scenario.sampling.truth_period_s = scenario.sampling.odometry_period_s;
  const World world = simulate(scenario);
  ASSERT_EQ(world.odometry.size(), world.truth.size());
  const Pose2 T_world_odom = world.truth.front().T_world_body;
  for (std::size_t i = 0; i < world.truth.size(); ++i) {
    const Pose2 T_world_body = T_world_odom * world.odometry[i].T_odom_body;
    EXPECT_NEAR((T_world_body.position() - world.truth[i].T_world_body.position()).norm(), 0.0, 1e-4);
  }
}

TEST(Simulate, LagShiftsTheStampsOfOdometry) {
  Scenario scenario = lab(1, 1);
  const World prompt = simulate(scenario);
  scenario.odometer.lag_s = 0.2;
  const World late = simulate(scenario);
  ASSERT_EQ(prompt.odometry.size(), late.odometry.size());
  for (std::size_t i = 0; i < late.odometry.size(); ++i) {
    EXPECT_EQ(late.odometry[i].stamp + duration_from_seconds(0.2), prompt.odometry[i].stamp);
    EXPECT_EQ(late.odometry[i].T_odom_body, prompt.odometry[i].T_odom_body);
  }
}

TEST(Simulate, OdometryDriftsAsTheModelSays) {
  // Compares the squared final heading error of many drives with its expected value from distance and turns.
  constexpr int kSeeds = 200;
  double squares = 0.0, expected = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Scenario scenario = coloured_lab(static_cast<std::uint64_t>(seed));
    const World world = simulate(scenario);
    const Pose2 T_world_odom = world.truth.front().T_world_body;
    const Pose2 T_world_body = T_world_odom * world.odometry.back().T_odom_body;
    const double error_rad = wrap(world.truth.back().T_world_body.heading_rad - T_world_body.heading_rad);
    squares += error_rad * error_rad;
    for (std::size_t i = 1; i < world.odometry.size(); ++i) {
      const Control control = control_between(world.odometry[i - 1].T_odom_body, world.odometry[i].T_odom_body);
      expected += scenario.odometer.lambda_rotation_rad *
                  (std::abs(control.first_turn_rad) + std::abs(control.second_turn_rad));
    }
  }
  EXPECT_NEAR(squares / expected, 1.0, 0.3);  // chi-squared with 200 degrees of freedom: standard deviation 0.1
}

}  // namespace
}  // namespace azimuth
