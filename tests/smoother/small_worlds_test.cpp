// Worlds with a known optimum, and worlds that determine little.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/smoother/smoother.hpp"
#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

Motion drive(double x_m, double turn_rad = 0.0, double sigma = 1e-3) {
  Motion motion;
  motion.T_start_end = {x_m, 0.0, turn_rad};
  motion.covariance = sigma * sigma * Eigen::Matrix3d::Identity();
  motion.path_m = std::abs(x_m);
  motion.turned_rad = std::abs(turn_rad);
  return motion;
}

SmootherSettings to_the_end_without_kernel() {
  SmootherSettings settings;
  settings.kernel = RobustKernel::none;
  settings.converged_below = 1e-18;
  return settings;
}

TEST(SmallWorlds, TwoBearingsCrossAtTheLandmark) {
  SmootherSettings settings = to_the_end_without_kernel();
  settings.inverse_depth_sigma_per_m = 1e3;  // effectively no prior
  Smoother smoother(settings);
  const Eigen::Vector2d p(2.0, 3.0);
  const LandmarkId landmark = smoother.add_landmark(smoother.add_bearing(std::atan2(p.y(), p.x()), 0.01));
  smoother.add_pose(drive(1.0));
  smoother.assign(smoother.add_bearing(std::atan2(p.y(), p.x() - 1.0), 0.01), landmark);
  EXPECT_TRUE(smoother.optimise(50).converged);
  EXPECT_LT((smoother.graph().landmark(landmark).p_map() - p).norm(), 1e-4);
  EXPECT_LT(smoother.energy(), 1e-6);
}

TEST(SmallWorlds, HeadingIsTheWeightedMeanOfOdometryAndAFarBearing) {
  // GIVEN a landmark at infinity, which determines only the heading, seen straight ahead and then 0.1 rad to the right
  SmootherSettings settings = to_the_end_without_kernel();
  settings.inverse_depth_mean_per_m = 0.0;
  settings.inverse_depth_sigma_per_m = 1e-9;
  Smoother smoother(settings);
  const LandmarkId landmark = smoother.add_landmark(smoother.add_bearing(0.0, 0.01));
  smoother.add_pose(drive(1.0, 0.0, 0.02));
  smoother.assign(smoother.add_bearing(-0.1, 0.01), landmark);
  smoother.optimise(50);
  // THEN odometry's 0 and the 0.1 of the two bearings are weighted by their variances
  const double expected_rad = 0.1 * 4.0 / (4.0 + 2.0);
  EXPECT_NEAR(smoother.newest_pose().heading_rad, expected_rad, 1e-8);
  EXPECT_NEAR(smoother.newest_covariance()(2, 2), 1.0 / (1.0 / 4e-4 + 1.0 / 2e-4), 1e-9);
}

TEST(SmallWorlds, BearingsThatContradictEachOtherPushNoLandmarkBeyondAllBounds) {
  // GIVEN a landmark without a distance prior, whose chart moves along with the path
  SmootherSettings settings;
  settings.charts_go_along = true;
  Smoother smoother(settings);
  smoother.add_pose(drive(0.5, 0.1, 0.1));
  const LandmarkId landmark = smoother.add_landmark(smoother.add_bearing(0.7, 0.02));
  smoother.use_prior(landmark, false);
  // WHEN bearings in random directions are assigned to it
  for (const double azimuth_rad : {-1.01, -2.96, 1.94, -1.65, -3.0, -2.16, 0.02, -1.52, 2.26, 3.0, -0.9, 0.05}) {
    SCOPED_TRACE(azimuth_rad);
    smoother.add_pose(drive(0.5, 0.0, 0.1));
    smoother.assign(smoother.add_bearing(azimuth_rad, 0.02), landmark);
    smoother.optimise();
    // THEN the landmark stays finite, and the covariance of the pose is valid and not too small
    EXPECT_LT(std::abs(smoother.graph().landmark(landmark).inverse_distance_per_m), 100.0);
    const Eigen::Matrix3d P = smoother.newest_covariance();
    ASSERT_TRUE(P.allFinite());
    EXPECT_EQ(P.llt().info(), Eigen::Success);
    EXPECT_GT(P(0, 0), 0.015);
  }
}

TEST(SmallWorlds, WithoutItsPriorALandmarkThatNothingTellsIsKnownToBeNoPointOfThePath) {
  Smoother smoother(SmootherSettings{});
  const LandmarkId landmark = smoother.add_landmark(smoother.add_bearing(0.7, 0.02));
  smoother.use_prior(landmark, false);
  EXPECT_TRUE(smoother.optimise().converged);
  const Smoother::Unknown unknown = Smoother::LandmarkOf{landmark};
  const Eigen::MatrixXd P = smoother.covariance({&unknown, 1});
  const double sigma_per_m = 25.0 * SmootherSettings{}.inverse_depth_sigma_per_m;
  EXPECT_NEAR(P(1, 1), sigma_per_m * sigma_per_m, 1e-6);
}

TEST(SmallWorlds, OneBearingLeavesTheDistanceToThePrior) {
  const SmootherSettings settings = to_the_end_without_kernel();
  Smoother smoother(settings);
  const LandmarkId landmark = smoother.add_landmark(smoother.add_bearing(0.7, 0.02));
  EXPECT_TRUE(smoother.optimise().converged);
  const SmoothedLandmark& found = smoother.graph().landmark(landmark);
  EXPECT_NEAR(found.direction_rad, 0.7, 1e-9);
  EXPECT_NEAR(found.inverse_distance_per_m, settings.inverse_depth_mean_per_m, 1e-9);
  const Smoother::Unknown unknown = Smoother::LandmarkOf{landmark};
  const Eigen::MatrixXd P = smoother.covariance({&unknown, 1});
  EXPECT_NEAR(P(0, 0), 0.02 * 0.02, 1e-9);
  EXPECT_NEAR(P(1, 1), settings.inverse_depth_sigma_per_m * settings.inverse_depth_sigma_per_m, 1e-9);
}

TEST(SmallWorlds, WithoutBearingsThePathIsOdometry) {
  Smoother smoother(to_the_end_without_kernel());
  EXPECT_TRUE(smoother.optimise().converged);  // with no measurements
  EXPECT_EQ(smoother.newest_pose(), Pose2{});
  EXPECT_EQ(smoother.newest_covariance(), Eigen::Matrix3d::Zero());
  Pose2 expected;
  for (int i = 0; i < 10; ++i) {
    smoother.add_pose(drive(0.5, 0.3, 0.01));
    expected = expected * Pose2{0.5, 0.0, 0.3};
    smoother.optimise();
  }
  EXPECT_LT((smoother.newest_pose().vector() - expected.vector()).norm(), 1e-9);
  EXPECT_NEAR(smoother.newest_covariance()(2, 2), 10 * 1e-4, 1e-9);
  EXPECT_NEAR(smoother.energy(), 0.0, 1e-12);
}

TEST(SmallWorlds, WhatIsInfinitelyFarSettlesAboutInfinity) {
  // GIVEN a landmark seen in a constant direction along 30 m of straight path
  Smoother smoother(to_the_end_without_kernel());
  LandmarkId landmark = kOfNothing;
  for (int i = 0; i < 30; ++i) {
    if (i > 0) smoother.add_pose(drive(1.0));
    const BearingId bearing = smoother.add_bearing(1.0, 0.002);
    if (i == 0)
      landmark = smoother.add_landmark(bearing);
    else
      smoother.assign(bearing, landmark);
    smoother.optimise();
  }
  // THEN its inverse distance is zero within its standard deviation, on either side
  const Smoother::Unknown unknown = Smoother::LandmarkOf{landmark};
  const double sigma = std::sqrt(smoother.covariance({&unknown, 1})(1, 1));
  EXPECT_LT(sigma, 1e-3);
  EXPECT_LT(std::abs(smoother.graph().landmark(landmark).inverse_distance_per_m), 3.0 * sigma);
}

TEST(SmallWorlds, BearingsThatDivergePutItBeyondInfinity) {
  // GIVEN diverging rays: no point explains them, but one beyond infinity does
  SmootherSettings settings = to_the_end_without_kernel();
  settings.inverse_depth_sigma_per_m = 100.0;
  Smoother smoother(settings);
  const LandmarkId landmark = smoother.add_landmark(smoother.add_bearing(1.0, 0.001));
  for (int i = 0; i < 10; ++i) {
    smoother.add_pose(drive(0.3));
    smoother.assign(smoother.add_bearing(1.0 - 0.005 * (i + 1), 0.001), landmark);
    smoother.optimise();
  }
  EXPECT_LT(smoother.graph().landmark(landmark).inverse_distance_per_m, 0.0);
  EXPECT_FALSE(smoother.graph().landmark(landmark).is_point());
  EXPECT_TRUE(std::isfinite(smoother.energy()));
  EXPECT_GT(smoother.newest_covariance().determinant(), 0.0);
}

TEST(SmallWorlds, DrivingOverALandmarkBreaksNothing) {
  Smoother smoother{SmootherSettings{}};
  const Eigen::Vector2d p(2.0, 0.0);
  LandmarkId landmark = kOfNothing;
  for (int i = 0; i <= 40; ++i) {
    if (i > 0) smoother.add_pose(drive(0.1));
    const double ahead_m = p.x() - 0.1 * i;
    const BearingId bearing = smoother.add_bearing(ahead_m > -1e-9 ? 0.02 : kPi - 0.02, 0.05);
    if (i == 0)
      landmark = smoother.add_landmark(bearing);
    else
      smoother.assign(bearing, landmark);
    smoother.optimise();
    ASSERT_TRUE(std::isfinite(smoother.energy())) << i;
    ASSERT_TRUE(smoother.newest_covariance().allFinite()) << i;
  }
  EXPECT_LT((smoother.newest_pose().position() - Eigen::Vector2d(4.0, 0.0)).norm(), 0.05);
}

TEST(SmallWorlds, ASimulatedDriveEndsWithinItsCovariance) {
  double sum = 0.0;
  constexpr int kDrives = 30;
  for (std::uint64_t seed = 1; seed <= kDrives; ++seed) {
    const NamedDrive drive = named_drive({.seed = seed, .images = 80});
    Smoother smoother{SmootherSettings{}};
    for (DriveFeeder feeder(drive); !feeder.done();) {
      feeder.feed(smoother);
      smoother.optimise();
    }
    Eigen::Vector3d error = smoother.newest_pose().vector() - drive.images.back().T_first_body.vector();
    error.z() = wrap(error.z());
    sum += error.dot(smoother.newest_covariance().ldlt().solve(error));
  }
  // 95 % interval of the mean of 30 chi-squared values with 3 degrees of freedom
  EXPECT_GT(sum / kDrives, 2.1);
  EXPECT_LT(sum / kDrives, 4.0);
}

}  // namespace
}  // namespace azimuth
