// The smoother's estimate of its rig: the noise of bearings and odometry, and the values of the rig that a drive
// contradicts.

#include "slam/smoother/rig_belief.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

constexpr CalibrationPriors kSaid{.sigma_scale_turn = 0.01, .sigma_camera_yaw_rad = 0.005, .sigma_lag_s = 0.02};
constexpr RigDoubts kDoubts{.if_wrong = {.sigma_scale_turn = 0.3, .sigma_camera_yaw_rad = 0.1, .sigma_lag_s = 0.3},
                            .noise = false};

Smoother driven(const NamedDriveOptions& options, const CalibrationPriors& calibration, bool depth_prior = true) {
  const NamedDrive drive = named_drive(options);
  SmootherSettings settings;
  settings.calibration = calibration;
  if (!depth_prior) settings.inverse_depth_sigma_per_m = 10.0;
  Smoother smoother(settings);
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise();
  }
  return smoother;
}

/// A smoother whose bearings and odometry are noisier than stated by the factors `bearings` and `odometry`.
Smoother noisy(std::uint64_t seed, double bearings, double odometry, const CalibrationPriors& calibration = {}) {
  Smoother smoother = driven({.seed = seed, .images = 150}, calibration);
  smoother.scale_noise(1.0 / bearings, 1.0 / odometry);
  smoother.optimise(50);
  return smoother;
}

struct Ratios {
  double bearings = 1.0, odometry = 1.0;
};

/// Each ratio depends on the other, so the estimate needs several rounds.
Ratios found(Smoother smoother) {
  Ratios all;
  for (int round = 0; round < 10; ++round) {
    const Ratios now{smoother.bearing_noise().ratio, smoother.odometry_noise(1).ratio};
    smoother.scale_noise(now.bearings, now.odometry);
    smoother.optimise(20);
    all.bearings *= now.bearings;
    all.odometry *= now.odometry;
  }
  return all;
}

TEST(NoiseFound, IsThatOfBearingsAndOfOdometryEach) {
  constexpr int kSeeds = 10;
  for (const auto& [bearings, odometry] :
       {std::array{1.0, 1.0}, {3.0, 1.0}, {1.0, 3.0}, {0.3, 1.0}, {1.0, 0.3}, {4.0, 4.0}, {0.5, 2.0}}) {
    double log_bearings = 0.0, log_odometry = 0.0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Ratios ratios = found(noisy(seed, bearings, odometry));
      log_bearings += std::log(ratios.bearings) / kSeeds;
      log_odometry += std::log(ratios.odometry) / kSeeds;
    }
    fmt::print("bearings {:.1f} times: found {:.2f}; odometry {:.1f} times: found {:.2f}\n", bearings,
               std::exp(log_bearings), odometry, std::exp(log_odometry));
    EXPECT_NEAR(log_bearings, std::log(bearings), std::log(1.15));
    EXPECT_NEAR(log_odometry, std::log(odometry), std::log(1.25));
  }
}

// The degrees of freedom equal the number of residuals minus the number of unknowns.
TEST(NoiseFound, CountsTheUnknownsOnce) {
  const Smoother smoother = noisy(1, 1.0, 1.0);
  const BearingGraph& graph = smoother.graph();
  const int residuals = graph.misfit_of_bearings().residuals + graph.misfit_of_odometry(1).residuals;
  EXPECT_NEAR(smoother.bearing_noise().told + smoother.odometry_noise(1).told, residuals - graph.rows(),
              0.05 * residuals);
}

// A scale error has a larger effect over long paths than from image to image.
TEST(NoiseFound, IsLargerOverLongWaysWhereErrorsAddUp) {
  const NamedDrive drive = named_drive({.images = 200, .scale_turn = 1.1});
  Smoother smoother(SmootherSettings{});
  for (DriveFeeder feeder(drive); !feeder.done();) feeder.feed(smoother);
  smoother.optimise(100);
  fmt::print("{:.2f} image to image, {:.2f} over sixteen\n", smoother.odometry_noise(1).ratio,
             smoother.odometry_noise(16).ratio);
  EXPECT_GT(smoother.odometry_noise(16).ratio, 1.3 * smoother.odometry_noise(1).ratio);
}

TEST(NoiseFound, SaysNothingOfADriveTooShortToTell) {
  Smoother smoother(SmootherSettings{});
  EXPECT_EQ(smoother.bearing_noise().ratio, 1.0);
  EXPECT_EQ(smoother.odometry_noise(4).told, 0.0);
}

// The result equals that of a graph with the scaled noise from the start.
TEST(ScaledNoise, GivesThePosesAndTheCovarianceOfThatNoise) {
  Smoother there_and_back = noisy(3, 0.5, 2.0);
  there_and_back.scale_noise(0.5, 2.0);
  there_and_back.optimise(50);
  const Smoother plain = noisy(3, 1.0, 1.0);
  EXPECT_NEAR(there_and_back.energy(), plain.energy(), 1e-3);
  EXPECT_LT((there_and_back.newest_pose().vector() - plain.newest_pose().vector()).norm(), 1e-3);
  EXPECT_LT((there_and_back.newest_covariance() - plain.newest_covariance()).norm(),
            0.01 * plain.newest_covariance().norm());
}

RigBelief judged_drive(const NamedDriveOptions& options, Smoother& smoother) {
  const NamedDrive drive = named_drive(options);
  for (DriveFeeder feeder(drive); !feeder.done();) {
    feeder.feed(smoother);
    smoother.optimise();
  }
  smoother.optimise(50);
  return judged(smoother, rig_belief(kSaid), rig_belief(kSaid), kDoubts);
}

SmootherSettings with_rig() {
  SmootherSettings settings;
  settings.calibration = kSaid;
  return settings;
}

TEST(Rig, IsBelievedByADriveThatAgreesWithIt) {
  int doubted = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Smoother smoother(with_rig());
    doubted += judged_drive({.seed = seed, .images = 150}, smoother).sigma == rig_belief(kSaid).sigma ? 0 : 1;
  }
  EXPECT_LE(doubted, 1);
}

TEST(Rig, IsDoubtedWhereADriveContradictsIt) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Smoother smoother(with_rig());
    const RigBelief belief = judged_drive({.seed = seed, .images = 150, .camera_yaw_rad = 0.08}, smoother);
    EXPECT_EQ(belief.sigma[calibration::yaw], kDoubts.if_wrong.sigma_camera_yaw_rad) << "seed " << seed;
    ASSERT_TRUE(change(smoother, rig_belief(kSaid), belief));
    smoother.optimise(50);
    EXPECT_NEAR(smoother.graph().calibration()[calibration::yaw], 0.08, 0.015) << "seed " << seed;
  }
}

TEST(Rig, IsBelievedAgainOnceTheDriveNoLongerContradictsIt) {
  Smoother smoother(with_rig());
  judged_drive({.images = 150}, smoother);
  RigBelief wrong = rig_belief(kSaid);
  wrong.sigma[calibration::yaw] = kDoubts.if_wrong.sigma_camera_yaw_rad;
  ASSERT_TRUE(change(smoother, rig_belief(kSaid), wrong));
  smoother.optimise(50);
  EXPECT_EQ(judged(smoother, wrong, rig_belief(kSaid), kDoubts).sigma, rig_belief(kSaid).sigma);
}

// A mirrored camera, whose azimuths grow the other way, cannot be explained by a yaw error.
TEST(Rig, IsGivenUpOnWhereNoRigLikeItFits) {
  Smoother smoother(with_rig());
  judged_drive({.images = 150, .camera_yaw_rad = 0.6}, smoother);
  RigBelief wrong = rig_belief(kSaid);
  wrong.sigma[calibration::yaw] = 10.0 * kDoubts.if_wrong.sigma_camera_yaw_rad;  // leaves the yaw practically free
  wrong.doubted[calibration::yaw] = true;
  ASSERT_TRUE(change(smoother, rig_belief(kSaid), wrong));
  smoother.optimise(200);
  ASSERT_GT(std::abs(smoother.graph().calibration()[calibration::yaw]), 0.3);
  const RigBelief given_up = judged(smoother, wrong, rig_belief(kSaid), kDoubts);
  EXPECT_TRUE(given_up.is_beyond_repair());
  EXPECT_EQ(given_up.sigma, rig_belief(kSaid).sigma);
  EXPECT_FALSE(given_up.doubts_any());
  EXPECT_EQ(judged(smoother, given_up, rig_belief(kSaid), kDoubts).sigma, given_up.sigma);  // and the decision persists
}

constexpr std::array kTold{calibration::scale_turn, calibration::drift, calibration::yaw, calibration::camera_x,
                           calibration::camera_y};

// The errors of a graph without these unknowns, after measurements were corrected by what is told, are those of a graph
// with them.
TEST(RigEvidence, IsThatOfAGraphWithTheErrorsAsUnknowns) {
  constexpr CalibrationPriors kPriors{
      .sigma_scale_turn = 0.1, .sigma_drift_rad_per_m = 0.03, .sigma_camera_yaw_rad = 0.05, .sigma_camera_m = 0.1};
  constexpr NamedDriveOptions kWrong{.seed = 5, .images = 150, .scale_turn = 1.02, .camera_yaw_rad = 0.03};
  constexpr bool kDepthPrior = false;  // it depends on where a landmark seemed to be at first
  Smoother estimated = driven(kWrong, kPriors, kDepthPrior);
  for (int i = 0; i < 20; ++i) {  // a factor that is slightly out of date leaves weakly told values where they are
    estimated.start_factor_anew();
    estimated.optimise(50);
  }
  const auto P = estimated.calibration_covariance();

  Smoother corrected = driven(kWrong, {}, kDepthPrior);
  Calibration errors = Calibration::Zero();
  Eigen::MatrixXd M;
  for (int i = 0; i < 8; ++i) {
    corrected.optimise(50);
    RigEvidence<kCalibrations> evidence = corrected.rig_evidence();
    evidence.pull += evidence.information * errors;
    M = evidence.information(kTold, kTold);
    for (std::size_t value = 0; value < kTold.size(); ++value) {
      const auto at = static_cast<Eigen::Index>(value);
      M(at, at) += 1.0 / std::pow(sigmas(kPriors)[kTold[value]], 2);
    }
    M = M.inverse().eval();
    Calibration next = Calibration::Zero();
    next(kTold) = M * evidence.pull(kTold);
    corrected.correct(next - errors);
    errors = next;
  }
  for (std::size_t i = 0; i < kTold.size(); ++i) {
    const int value = kTold[i];
    const double sigma = std::sqrt(P(value, value));
    const auto at = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(std::sqrt(M(at, at)) / sigma, 1.0, 0.02) << value;
    EXPECT_NEAR(errors[value], estimated.graph().calibration()[value], 0.05 * sigma) << value;
  }
  EXPECT_NEAR(errors[calibration::yaw], kWrong.camera_yaw_rad, 4.0 * std::sqrt(P(calibration::yaw, calibration::yaw)));
}

TEST(RigEvidence, IsNothingWithoutBearings) {
  const Smoother smoother(SmootherSettings{});
  EXPECT_TRUE(smoother.rig_evidence().information.isZero(0.0));
}

// Where all measurements fit, second derivatives of the energy are exact.
TEST(RigEvidence, HasTheDerivativesOfTheEnergy) {
  constexpr double kStep = 1e-5;
  Smoother smoother = driven({.images = 40}, {});
  smoother.optimise(50);
  const BearingGraph graph = smoother.graph();
  const auto energy_at = [&](int value, double error) {
    BearingGraph moved = graph;
    moved.correct(error * Calibration::Unit(value));
    moved.evaluate();
    return moved;
  };
  const BearingGraph::ByCalibration by = graph.by_calibration();
  for (const int value : kTold) {
    const BearingGraph after = energy_at(value, kStep), before = energy_at(value, -kStep);
    const double slope = (after.energy() - before.energy()) / (2.0 * kStep);
    EXPECT_NEAR(by.slope[value], slope, 1e-5 * std::sqrt(by.curvature(value, value))) << value;
    // Gauss-Newton leaves out the curvature of residuals and kernel, so these agree as far as residuals are small.
    const double curvature =
        (after.by_calibration().slope[value] - before.by_calibration().slope[value]) / (2.0 * kStep);
    EXPECT_NEAR(by.curvature(value, value) / curvature, 1.0, 0.25) << value;
    const Eigen::VectorXd mixed = (after.gradient() - before.gradient()) / (2.0 * kStep);
    EXPECT_NEAR(by.mixed.col(value).dot(mixed) / mixed.squaredNorm(), 1.0, 0.25) << value;
  }
}

// A value that the rig declares exact is not an unknown.
TEST(Rig, IsNeverDoubtedWhereItIsExact) {
  Smoother smoother(SmootherSettings{});
  const NamedDrive drive = named_drive({.images = 100, .camera_yaw_rad = 0.08});
  for (DriveFeeder feeder(drive); !feeder.done();) feeder.feed(smoother);
  smoother.optimise(50);
  EXPECT_EQ(judged(smoother, rig_belief({}), rig_belief({}), kDoubts).sigma, Calibration::Zero());
}

}  // namespace
}  // namespace azimuth
