// Calibration errors of odometry and camera as unknowns of the graph.

#include <Eigen/LU>
#include <array>
#include <gtest/gtest.h>

#include "slam/smoother/smoother.hpp"
#include "tests/support/batch_solution.hpp"
#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

constexpr CalibrationPriors kAll{0.02, 0.05, 0.02, 0.03, 0.1, 0.01, 5.0, 0.05};

Smoother smoothed(const NamedDrive& drive, const SmootherSettings& settings) {
  Smoother smoother(settings);
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise();
  }
  smoother.optimise(200);
  return smoother;
}

TEST(SmootherCalibration, TurnScaleAndCameraYawAreFound) {
  // GIVEN odometry that reports turns 15 % too large, and a camera turned by 6 degrees
  const NamedDrive drive = named_drive({.images = 250, .scale_turn = 1.15, .camera_yaw_rad = 0.1});
  SmootherSettings settings;
  settings.calibration = {.sigma_scale_turn = 0.1, .sigma_camera_yaw_rad = 0.1};
  const Smoother smoother = smoothed(drive, settings);
  EXPECT_NEAR(smoother.graph().calibration()[calibration::scale_turn], 1.0 / 1.15 - 1.0, 0.02);
  EXPECT_NEAR(smoother.graph().calibration()[calibration::yaw], 0.1, 0.01);
  // THEN the path is more accurate than without calibration
  const auto error_m = [&](const Smoother& solved) {
    double sum = 0.0;
    for (std::size_t i = 0; i < drive.images.size(); ++i)
      sum += (solved.graph().pose(static_cast<PoseId>(i)).position() - drive.images[i].T_first_body.position())
                 .squaredNorm();
    return std::sqrt(sum / static_cast<double>(drive.images.size()));
  };
  EXPECT_LT(error_m(smoother), 0.6 * error_m(smoothed(drive, SmootherSettings{})));
}

TEST(SmootherCalibration, AllOfItTogetherIsTheBatchSolution) {
  const NamedDrive drive = named_drive({.seed = 4, .images = 100, .scale_turn = 1.03});
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  settings.calibration = kAll;
  const Smoother smoother = smoothed(drive, settings);
  BatchProblem batch(smoother.graph(), settings);
  ASSERT_GT(batch.solve(), 0);
  EXPECT_LT(largest_difference(batch.values(), smoother.graph().values()), 1e-6);
  EXPECT_GT(smoother.graph().calibration().cwiseAbs().minCoeff(), 1e-6);  // all of them moved
}

TEST(SmootherCalibration, GradientIsThatOfTheEnergy) {
  // The test would reveal any error in the derivatives of odometry by its calibration.
  const NamedDrive drive = named_drive({.seed = 8, .images = 12});
  SmootherSettings settings;
  settings.calibration = kAll;
  Smoother smoother(settings);
  for (DriveFeeder feeder(drive); !feeder.done();) feeder.feed(smoother);
  BatchProblem batch(smoother.graph(), settings);
  const Eigen::VectorXd gradient = batch.normal().gradient;
  for (Eigen::Index row = 0; row < batch.rows(); ++row) {
    constexpr double kSmall = 1e-6;
    BatchProblem above = batch, below = batch;
    above.move(kSmall * Eigen::VectorXd::Unit(batch.rows(), row));
    below.move(-kSmall * Eigen::VectorXd::Unit(batch.rows(), row));
    const double slope = (above.energy() - below.energy()) / (2.0 * kSmall);
    EXPECT_NEAR(gradient[row], slope, 1e-4 * (1.0 + std::abs(slope))) << row;
  }
}

TEST(SmootherCalibration, CovarianceIsThatOfTheDenseInverse) {
  const NamedDrive drive = named_drive({.seed = 5, .images = 40});
  SmootherSettings settings;
  settings.kernel = RobustKernel::none;
  settings.relinearise_beyond = settings.reweigh_beyond = 0.0;
  settings.calibration = {.sigma_scale_turn = 0.05, .sigma_lag_s = 0.1, .sigma_centre_px = 5.0};
  const Smoother smoother = smoothed(drive, settings);
  const auto covariance = smoother.calibration_covariance();
  const BatchProblem batch(smoother.graph(), settings);
  const Eigen::MatrixXd lower(batch.normal().H);
  const Eigen::MatrixXd whole = Eigen::MatrixXd(lower.selfadjointView<Eigen::Lower>()).inverse();
  constexpr std::array kFree{calibration::scale_turn, calibration::lag, calibration::centre_x, calibration::centre_y};
  const auto first = whole.rows() - static_cast<Eigen::Index>(kFree.size());  // the calibrations are the last unknowns
  for (std::size_t i = 0; i < kFree.size(); ++i)
    for (std::size_t j = 0; j < kFree.size(); ++j) {
      const double expected = whole(first + static_cast<Eigen::Index>(i), first + static_cast<Eigen::Index>(j));
      EXPECT_NEAR(covariance(kFree[i], kFree[j]), expected,
                  1e-6 * std::sqrt(whole(first, first)) + 1e-6 * std::abs(expected));
    }
  EXPECT_EQ(covariance(calibration::drift, calibration::drift), 0.0);
}

TEST(SmootherCalibration, WhatBeginsAtTheSolutionStaysThere) {
  const NamedDrive drive = named_drive({.seed = 6, .images = 60, .scale_turn = 1.05});
  SmootherSettings settings;
  settings.converged_below = 1e-12;
  settings.calibration = kAll;
  const Smoother solved = smoothed(drive, settings);
  Smoother again(settings);
  for (DriveFeeder feeder(drive); !feeder.done();) feeder.feed(again);
  again.begin_at(solved.graph().values());
  const Smoother::Outcome outcome = again.optimise(100);
  EXPECT_TRUE(outcome.converged);
  EXPECT_LE(outcome.iterations, 2);
  EXPECT_NEAR(again.energy(), solved.energy(), 1e-8 * solved.energy());
  EXPECT_LT(largest_difference(again.graph().values(), solved.graph().values()), 1e-5);
}

TEST(SmootherCalibration, DriftTurnsThePathByHalfOfWhatItTurnsTheHeading) {
  // GIVEN an arc in many segments, and the same arc with a heading that drifts
  constexpr double kDrift_rad_per_m = 1e-4;
  const auto arc = [](double drift_rad_per_m) {
    Motion motion;
    for (int i = 0; i < 200; ++i) {
      const double turn_rad = 0.001 + 0.005 * drift_rad_per_m;
      append(motion, {0.005, 0.5 * turn_rad, 0.5 * turn_rad}, {0.005, 0.0, 0.0}, {1e-3, 1e-3, 1e-3, 1e-2});
    }
    return motion;
  };
  SmootherSettings settings;
  settings.calibration.sigma_drift_rad_per_m = 0.1;
  BearingGraph graph(settings, {});
  graph.add_pose(arc(0.0));
  const Eigen::Vector3d expected =
      (arc(kDrift_rad_per_m).T_start_end.vector() - arc(0.0).T_start_end.vector()) / kDrift_rad_per_m;
  EXPECT_LT((graph.odometry_to(1).by_calibration.col(2) - expected).norm(), 0.02);
}

}  // namespace
}  // namespace azimuth
