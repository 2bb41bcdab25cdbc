#include "slam/estimator/odometry_track.hpp"

#include <gtest/gtest.h>

#include "sim/world/simulate.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

OdometryRig exact_rig() {
  OdometryRig rig;
  rig.lambda_distance_m = rig.lambda_rotation_rad = 0.0;
  return rig;
}

OdometryReading reading(double t_s, const Pose2& T_odom_body, std::uint32_t origin = 0) {
  return {Stamp{duration_from_seconds(t_s)}, 0, origin, T_odom_body};
}

void expect_near(const Pose2& pose, const Pose2& expected, double tolerance) {
  EXPECT_NEAR(pose.x_m, expected.x_m, tolerance);
  EXPECT_NEAR(pose.y_m, expected.y_m, tolerance);
  EXPECT_NEAR(wrap(pose.heading_rad - expected.heading_rad), 0.0, tolerance);
}

/// A lap whose odometer has only the systematic errors that the rig describes.
Scenario miscalibrated_lap() {
  Scenario scenario = lab(1, 1);
  scenario.odometer = {0.0, 0.0, 0.0, 0.0, 0.965, 0.945, -0.05, 0.2};
  scenario.sampling.truth_period_s = scenario.sampling.odometry_period_s = 0.01;
  return scenario;
}

OdometryRig rig_of(const OdometerSettings& odometer) {
  OdometryRig rig = exact_rig();
  rig.scale_distance = odometer.scale_distance;
  rig.scale_turn = odometer.scale_turn;
  rig.drift_rad_per_m = odometer.drift_rad_per_m;
  rig.lag_s = odometer.lag_s;
  return rig;
}

double largest_position_error(const World& world, const OdometryRig& rig) {
  OdometryTrack track(rig);
  const Pose2 T_odom_world = inverse(world.truth.front().T_world_body);
  double largest_m = 0.0;
  for (std::size_t i = 0; i < world.odometry.size(); ++i) {
    track.add(world.odometry[i]);
    const Pose2 T_odom_body = track.advance_to(world.truth[i].stamp).T_odom_body;
    const Pose2 expected = T_odom_world * world.truth[i].T_world_body;
    largest_m = std::max(largest_m, (T_odom_body.position() - expected.position()).norm());
  }
  return largest_m;
}

TEST(OdometryTrack, CalibrationRecoversTheDrive) {
  const Scenario scenario = miscalibrated_lap();
  const World world = simulate(scenario);
  EXPECT_LT(largest_position_error(world, rig_of(scenario.odometer)), 5e-3);  // stamps and samples are rounded
  EXPECT_GT(largest_position_error(world, exact_rig()), 1.0);
}

TEST(OdometryTrack, CalibrationHoldsAtTheOdometersUsualRate) {
  Scenario scenario = miscalibrated_lap();
  scenario.sampling.truth_period_s = scenario.sampling.odometry_period_s = 0.1;
  EXPECT_LT(largest_position_error(simulate(scenario), rig_of(scenario.odometer)), 0.03);
}

TEST(OdometryTrack, CalibrationScalesAReverseDriveToo) {
  OdometryRig rig = exact_rig();
  rig.scale_distance = 0.9;
  rig.drift_rad_per_m = 0.1;
  OdometryTrack track(rig);
  track.add(reading(0.0, {}));
  track.add(reading(1.0, {-1.0, 0.0, 0.0}));
  const OdometryTrack::Step step = track.advance_to(at_s(1.0));
  EXPECT_NEAR(step.T_odom_body.position().norm(), 0.9, 1e-12);
  EXPECT_NEAR(step.T_odom_body.heading_rad, -0.09, 1e-12);  // in reverse, the drift turns the other way
  EXPECT_NEAR(step.motion.path_m, 0.9, 1e-12);
}

TEST(OdometryTrack, LagMovesTheStamps) {
  OdometryRig rig = exact_rig();
  rig.lag_s = 0.2;
  OdometryTrack track(rig);
  track.add(reading(1.0, {}));
  track.add(reading(2.0, {1.0, 0.0, 0.0}));
  EXPECT_EQ(track.oldest(), at_s(1.2));
  EXPECT_EQ(track.newest(), at_s(2.2));
  EXPECT_EQ(track.first_from(at_s(1.3)), at_s(2.2));
  EXPECT_EQ(track.first_from(at_s(2.2)), at_s(2.2));
  EXPECT_FALSE(track.first_from(at_s(2.3)));
  EXPECT_NEAR(track.advance_to(at_s(1.7)).T_odom_body.x_m, 0.5, 1e-12);
}

TEST(OdometryTrack, AClockThatDriftsMakesTheLagGrowFromTheFirstReadingOn) {
  OdometryRig rig = exact_rig();
  rig.lag_s = 0.2;
  rig.clock_drift = 0.01;
  OdometryTrack track(rig);
  track.add(reading(100.0, {}));
  track.add(reading(110.0, {1.0, 0.0, 0.0}));
  EXPECT_EQ(track.oldest(), at_s(100.2));
  EXPECT_EQ(track.newest(), at_s(110.3));
}

/// The motions between instants that are all `lag_s` earlier than the regular ones.
std::vector<Motion> motions_earlier_by(double lag_s, const World& world) {
  OdometryTrack track(exact_rig());
  for (const OdometryReading& sample : world.odometry) track.add(sample);
  std::vector<Motion> motions;
  for (double t_s = 1.0; at_s(t_s) < track.newest(); t_s += 0.27)
    motions.push_back(track.advance_to(at_s(t_s - lag_s)).motion);
  return motions;
}

TEST(OdometryTrack, DerivativesByALagOfTheInstants) {
  constexpr double kStep_s = 1e-3;
  const World world = simulate(miscalibrated_lap());
  const std::vector<Motion> motions = motions_earlier_by(0.0, world), before = motions_earlier_by(-kStep_s, world),
                            after = motions_earlier_by(kStep_s, world);
  const auto slope = [](const Motion& from, const Motion& to, double step_s) {
    Eigen::Vector3d change = to.T_start_end.vector() - from.T_start_end.vector();
    change.z() = wrap(change.z());
    return Eigen::Vector3d(change / step_s);
  };
  int compared = 0;
  double largest = 0.0;
  for (std::size_t i = 1; i < motions.size(); ++i) {  // the first motion always starts at the first reading
    const Eigen::Vector3d backward = slope(before[i], motions[i], kStep_s),
                          forward = slope(motions[i], after[i], kStep_s);
    if ((backward - forward).norm() > 0.01) continue;  // the turn rate changes at this instant
    // velocities are differences over 10 ms
    EXPECT_LT((motions[i].by_lag - 0.5 * (backward + forward)).norm(), 0.02) << i;
    largest = std::max(largest, forward.norm());
    ++compared;
  }
  EXPECT_GT(compared, 100);
  EXPECT_GT(largest, 0.1);
}

TEST(OdometryTrack, OfReadingsThatAreFarApartNothingIsSaidOfALag) {
  OdometryTrack track(exact_rig());
  for (int i = 0; i <= 20; ++i) track.add(reading(1.0 * i, {0.02 * i * i, 0.0, 0.0}));
  track.advance_to(at_s(0.9));
  for (const double t_s : {1.8, 3.0, 4.5}) {
    const Motion motion = track.advance_to(at_s(t_s)).motion;
    EXPECT_TRUE(motion.by_lag.isZero(0.0)) << t_s;
    EXPECT_GT(motion.velocity_at_end.x(), 0.0) << t_s;
  }
}

TEST(OdometryTrack, SwappedWheelsTurnTheOtherWayAndDriftTheSame) {
  OdometryRig rig = exact_rig();
  rig.wheels_swapped = true;
  rig.drift_rad_per_m = 0.1;
  OdometryTrack track(rig);
  track.add(reading(0.0, {}));
  track.add(reading(1.0, {1.0, 0.0, 0.3}));
  EXPECT_NEAR(track.advance_to(at_s(1.0)).T_odom_body.heading_rad, -0.3 + 0.1, 1e-12);
}

TEST(OdometryTrack, InterpolatesBetweenReadings) {
  OdometryTrack track(exact_rig());
  track.add(reading(0.0, {0.0, 0.0, 3.1}));
  track.add(reading(1.0, {1.0, 2.0, -3.1}));
  const OdometryTrack::Step step = track.advance_to(at_s(0.25));
  // The first reading is the origin of the track, and its heading of 3.1 rad is the track's zero.
  const Pose2 T_first_end = inverse(Pose2{0.0, 0.0, 3.1}) * Pose2{1.0, 2.0, -3.1};
  expect_near(step.T_odom_body, interpolate({}, T_first_end, 0.25), 1e-12);
  expect_near(step.motion.T_start_end, step.T_odom_body, 1e-12);
}

TEST(OdometryTrack, StepsJoinWithoutLossWhereverTheyAreCut) {
  RandomDraws draws(41);
  const World world = simulate(lab(2, 1));
  OdometryTrack track(exact_rig());
  for (const OdometryReading& sample : world.odometry) track.add(sample);
  Pose2 T_start_now;
  double path_m = 0.0, t_s = 0.0;
  while (at_s(t_s) < track.newest()) {
    t_s += draws.uniform(0.0, 1.5);  // several readings in one step, or several steps between two readings
    const OdometryTrack::Step step = track.advance_to(at_s(t_s));
    T_start_now = T_start_now * step.motion.T_start_end;
    path_m += step.motion.path_m;
    expect_near(T_start_now, step.T_odom_body, 1e-9);
  }
  expect_near(T_start_now, world.odometry.back().T_odom_body, 1e-9);
  EXPECT_NEAR(path_m, 32.0, 1.5);
}

TEST(OdometryTrack, RestartedOdometerGoesOnWithoutAJump) {
  OdometryTrack track(exact_rig());
  track.add(reading(0.0, {}, 1));
  track.add(reading(1.0, {1.0, 0.0, kPi / 2}, 1));
  track.add(reading(2.0, {50.0, 50.0, -1.0}, 2));  // a new origin: the pose stays, and the motion in between is unknown
  expect_near(track.advance_to(at_s(2.0)).T_odom_body, {1.0, 0.0, kPi / 2}, 1e-12);
  track.add(reading(3.0, Pose2{50.0, 50.0, -1.0} * Pose2{2.0, 0.0, 0.0}, 2));
  const OdometryTrack::Step step = track.advance_to(at_s(3.0));
  expect_near(step.T_odom_body, {1.0, 2.0, kPi / 2}, 1e-12);
  EXPECT_NEAR(step.motion.path_m, 2.0, 1e-12);
}

TEST(OdometryTrack, InstantsOutsideTheReadingsAreClamped) {
  OdometryTrack track(exact_rig());
  EXPECT_TRUE(track.empty());
  track.add(reading(1.0, {}));
  track.add(reading(2.0, {1.0, 0.0, 0.0}));
  const OdometryTrack::Step early = track.advance_to(at_s(0.5));
  expect_near(early.T_odom_body, {}, 0.0);
  EXPECT_FALSE(early.motion.moved());
  EXPECT_NEAR(track.advance_to(at_s(9.0)).T_odom_body.x_m, 1.0, 1e-12);
  EXPECT_FALSE(track.advance_to(at_s(9.5)).motion.moved());
  EXPECT_FALSE(track.advance_to(at_s(1.5)).motion.moved());  // this instant has already passed
  EXPECT_EQ(track.oldest(), at_s(2.0));
}

OdometryReading doubtful(double t_s, const Pose2& T_odom_body, double sigma_gap_m, double sigma_gap_rad) {
  OdometryReading result = reading(t_s, T_odom_body);
  result.sigma_gap_m = sigma_gap_m;
  result.sigma_gap_rad = sigma_gap_rad;
  return result;
}

TEST(OdometryTrack, WhatTheOdometerDoubtsIsChargedOnce) {
  OdometryTrack track(exact_rig());
  track.add(reading(1.0, {}));
  track.add(doubtful(2.0, {}, 0.3, 0.2));  // the odometer may have missed a motion
  track.add(reading(3.0, {1.0, 0.0, 0.0}));
  const Eigen::Vector3d expected(0.09, 0.09, 0.04);
  EXPECT_NEAR((track.peek().motion.covariance.diagonal() - expected).tail<1>()(0), 0.0, 1e-15);
  const OdometryTrack::Step across = track.advance_to(at_s(2.0));
  EXPECT_TRUE(across.motion.covariance.isApprox(Eigen::Matrix3d(expected.asDiagonal()), 1e-12));
  EXPECT_TRUE(track.advance_to(at_s(3.0)).motion.covariance.isZero(1e-15));
}

TEST(OdometryTrack, StepsWithinAGapShareItsDoubt) {
  OdometryTrack track(exact_rig());
  track.add(reading(0.0, {}));
  track.add(doubtful(1.0, {}, 0.3, 0.2));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const double t_s : {0.2, 0.5, 0.9, 1.0}) {
    const Eigen::Vector3d share = track.advance_to(at_s(t_s)).motion.covariance.diagonal();
    EXPECT_GT(share.minCoeff(), 0.0) << t_s;
    sum += share;
  }
  EXPECT_TRUE(sum.isApprox(Eigen::Vector3d(0.09, 0.09, 0.04), 1e-12)) << sum.transpose();
}

TEST(OdometryTrack, PeekIsWhatAdvancingWouldGive) {
  OdometryRig rig;
  const World world = simulate(lab(3, 1));
  OdometryTrack track(rig);
  for (std::size_t i = 0; i < 200; ++i) {
    track.add(world.odometry[i]);
    if (i == 100) track.advance_to(track.newest() - duration_from_seconds(0.04));
  }
  const OdometryTrack::Step peeked = track.peek();
  const OdometryTrack::Step again = track.peek();
  const OdometryTrack::Step advanced = track.advance_to(track.newest());
  EXPECT_EQ(peeked.T_odom_body, advanced.T_odom_body);
  EXPECT_EQ(peeked.motion.T_start_end, advanced.motion.T_start_end);
  EXPECT_EQ(peeked.motion.covariance, advanced.motion.covariance);
  EXPECT_EQ(again.motion.covariance, advanced.motion.covariance);
  EXPECT_EQ(peeked.motion.path_m, advanced.motion.path_m);
}

}  // namespace
}  // namespace azimuth
