// The EKF with robots that differ from their rig.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "settings/configured_estimator.hpp"
#include "slam/geometry/random.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/encoder_robot.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {
namespace {

constexpr int kRobots = 20;

struct FilterTogether {
  double rmse_m = 0.0, anees = 0.0, worst = 0.0, tracking = 0.0;  ///< `anees` covers the steps with health `tracking`
  int judged = 0, doubted = 0;
  RigFinding last;  ///< finding for the last robot
};

using RobotOf = std::function<EncoderRobot(std::uint64_t seed)>;
RobotOf always(const EncoderRobot& robot) {
  return [=](std::uint64_t) { return robot; };
}

double share_tracking(const std::vector<StepHealth>& healths) {
  return static_cast<double>(std::ranges::count(healths, Health::tracking, &StepHealth::health)) /
         static_cast<double>(healths.size());
}

FilterTogether filtered(const RobotOf& robot_of, bool considers) {
  FilterTogether all;
  Configuration configuration;
  configuration.estimator = EstimatorKind::ekf;
  configuration.ekf.update.consider_scales = considers;
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
    EncoderRobot robot = robot_of(seed);
    robot.seed = seed;
    const Run run = driven(robot);
    const Rig rig = rig_of(run);
    const ReplayResult result = replay(run, rig, configured_estimator(rig, configuration), StageSettings{});
    const Report report = evaluate(replay_record(run, rig, "ekf", 0, result));
    all.rmse_m += report.position_m.rmse / kRobots;
    all.tracking += share_tracking(result.healths) / kRobots;
    all.doubted += result.samples.rig.contradicts() ? 1 : 0;
    all.last = result.samples.rig;
    const double anees = report.tracking_consistency.anees;
    if (!std::isfinite(anees)) continue;
    all.anees += anees;
    all.worst = std::max(all.worst, anees);
    ++all.judged;
  }
  all.anees /= std::max(1, all.judged);
  return all;
}

struct BeforeAndNow {
  FilterTogether exact, considered;  ///< results with a rig taken for exact, and with its uncertainty considered
};

BeforeAndNow by_ekf(const RobotOf& robot_of, const std::string& title) {
  const BeforeAndNow both{filtered(robot_of, false), filtered(robot_of, true)};
  fmt::print(
      "{:<28} rmse {:.4f} m, ANEES while tracking {:.2f} (worst {:.1f}); rig taken for exact {:.4f} m, {:.2f} "
      "({:.1f}); "
      "tracking {:.0f} %, contradicted {} of 20\n",
      title, both.considered.rmse_m, both.considered.anees, both.considered.worst, both.exact.rmse_m, both.exact.anees,
      both.exact.worst, 100.0 * both.considered.tracking, both.considered.doubted);
  return both;
}

/// A robot whose errors are drawn from the rig's standard deviations, times `sigmas`.
EncoderRobot drawn(std::uint64_t seed, double sigmas) {
  RandomNumbers<Xoshiro> numbers(Xoshiro(1000 + seed));
  const Rig silent;
  const auto off = [&](double sigma) { return numbers.normal(sigmas * sigma); };
  EncoderRobot robot;
  robot.camera_yaw_rad = off(silent.camera.sigma_yaw_rad);
  robot.p_body_camera_m = {off(silent.camera.sigma_position_m), off(silent.camera.sigma_position_m)};
  robot.scale_turn = 1.0 + off(silent.odometry.sigma_scale_turn);
  robot.drift_rad_per_m = off(silent.odometry.sigma_drift_rad_per_m);
  robot.image_lag_s = std::abs(off(silent.odometry.sigma_lag_s));
  return robot;
}

TEST(WrongRigsByEkf, ARightRigIsLeftAlone) {
  const auto [exact, considered] = by_ekf(always({}), "as the rig says");
  EXPECT_LE(considered.rmse_m, 1.01 * exact.rmse_m);
  EXPECT_LE(considered.anees, 3.0);
  EXPECT_GE(considered.tracking, 0.98);
  EXPECT_EQ(considered.doubted, 0);
}

TEST(WrongRigsByEkf, WhatARigSaysOfItselfIsInTheCovariance) {
  for (const double sigmas : {1.0, 2.0, 3.0}) {
    const auto [exact, considered] =
        by_ekf([=](std::uint64_t seed) { return drawn(seed, sigmas); }, fmt::format("off by {} sigma", sigmas));
    EXPECT_LE(considered.rmse_m, 1.01 * exact.rmse_m) << sigmas;
    EXPECT_LE(considered.anees, sigmas > 1.0 ? 6.0 : 3.0) << sigmas;
  }
}

TEST(WrongRigsByEkf, ACameraAskewIsFoundOut) {
  for (const double yaw_rad : {0.005, 0.01, 0.02, 0.04, 0.08, -0.12}) {
    const auto [exact, considered] = by_ekf(always({.camera_yaw_rad = yaw_rad}), fmt::format("askew {} rad", yaw_rad));
    EXPECT_LE(considered.anees, 6.0) << yaw_rad;
    if (std::abs(yaw_rad) < 0.03) continue;
    EXPECT_GE(considered.doubted, kRobots - 1) << yaw_rad;
    EXPECT_LE(considered.rmse_m, 0.7 * exact.rmse_m) << yaw_rad;
    ASSERT_TRUE(considered.last.yaw_offset_rad) << yaw_rad;
    EXPECT_NEAR(considered.last.yaw_offset_rad->found, yaw_rad, 0.02) << yaw_rad;
  }
}

TEST(WrongRigsByEkf, ACameraThatStandsElsewhereIsFoundOut) {
  for (const double ahead_m : {0.02, 0.1, 0.3, 0.5}) {
    const auto [exact, considered] =
        by_ekf(always({.p_body_camera_m = {ahead_m, -0.4 * ahead_m}}), fmt::format("{} m ahead", ahead_m));
    EXPECT_LE(considered.anees, 6.0) << ahead_m;
    if (ahead_m < 0.05) continue;
    EXPECT_GE(considered.doubted, kRobots - 1) << ahead_m;
    EXPECT_LE(considered.rmse_m, 0.7 * exact.rmse_m) << ahead_m;
  }
}

TEST(WrongRigsByEkf, TurnsThatAreNotAsReportedAreFoundOut) {
  for (const double scale : {0.8, 0.98, 1.35}) {
    const auto [exact, considered] = by_ekf(always({.scale_turn = scale}), fmt::format("turns times {}", scale));
    EXPECT_LE(considered.anees, 6.0) << scale;
    if (scale > 0.9 && scale < 1.1) continue;
    EXPECT_GE(considered.doubted, kRobots - 1) << scale;
    ASSERT_TRUE(considered.last.scale_turn) << scale;
    EXPECT_NEAR(considered.last.scale_turn->found, 1.0 / scale, 0.05) << scale;
  }
}

TEST(WrongRigsByEkf, ADriftIsCovered) {
  for (const double drift : {0.002, 0.01, 0.03}) {
    const auto both = by_ekf(always({.drift_rad_per_m = drift}), fmt::format("drift {} rad/m", drift));
    EXPECT_LE(both.considered.anees, 6.0) << drift;
  }
}

// With a lag of 0.2 s the gates reject most bearings in turns, so they carry no information.
TEST(WrongRigsByEkf, LateImagesAreCovered) {
  for (const double lag_s : {0.02, 0.05, 0.1, 0.2}) {
    const auto both = by_ekf(always({.image_lag_s = lag_s}), fmt::format("images {} s late", lag_s));
    EXPECT_LE(both.considered.anees, lag_s > 0.15 ? 9.0 : 6.0) << lag_s;
    EXPECT_LE(both.considered.anees, 0.8 * both.exact.anees) << lag_s;
  }
}

}  // namespace
}  // namespace azimuth
