// A camera with a lever arm that the rig states: every estimator must be as accurate as with a camera over the axle.

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ostream>
#include <string>

#include "settings/configured_estimator.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/data.hpp"
#include "tools/replay/replay_record.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {

static void PrintTo(EstimatorKind kind, std::ostream* out) { *out << name(kind); }  // for the tests' names

namespace {

Report replayed_by(EstimatorKind estimator, const Run& run, const Rig& rig) {
  Configuration configuration;
  configuration.estimator = estimator;
  const ReplayResult result = replay(run, rig, configured_estimator(rig, configuration), configuration.stage);
  return evaluate(replay_record(run, rig, std::string(name(estimator)), 0, result));
}

/// The same recording for a robot whose odometry and truth refer to a point behind and to the right of the camera. The
/// odometry noise is still that of a point below the camera, so position errors are comparable but covariances are not.
Run with_base_away(Run run, const Eigen::Vector2d& p_base_camera_m) {
  const Pose2 T_camera_base{-p_base_camera_m.x(), -p_base_camera_m.y(), 0.0};
  for (OdometryReading& reading : run.odometry) reading.T_odom_body = reading.T_odom_body * T_camera_base;
  for (TruthPose& truth : run.truth) truth.T_world_body = truth.T_world_body * T_camera_base;
  return run;
}

void expect_as_good_away(EstimatorKind estimator, const Run& run) {
  const Rig on_axle = rig_of(run);
  Rig rig = on_axle;
  rig.camera.position_m = {0.3, -0.2};
  const Report plain = replayed_by(estimator, run, on_axle);
  const Report known = replayed_by(estimator, with_base_away(run, {0.3, -0.2}), rig);
  fmt::print("{:<9} over the axle {:.4f} m, 0.36 m away {:.4f} m, mapped {} and {}, wrong bearings {} and {}\n",
             name(estimator), plain.position_m.rmse, known.position_m.rmse, plain.map.matched, known.map.matched,
             plain.association.sightings.wrong, known.association.sightings.wrong);
  EXPECT_LE(known.position_m.rmse, 1.2 * plain.position_m.rmse + 0.003);
  EXPECT_LE(known.association.sightings.wrong, plain.association.sightings.wrong + known.association.accepted / 100);
  EXPECT_GE(known.map.matched + 1, plain.map.matched);
}

TEST(MountsOnRuns, AreAsGoodAsOverTheAxleInTheLab) {
  for (const EstimatorKind estimator : {EstimatorKind::ekf, EstimatorKind::smoother})
    expect_as_good_away(estimator, load_run(test::source_folder() / "runs/lab").value());
}

TEST(MountsOnRuns, AreAsGoodAsOverTheAxleBelowLamps) {
  AZIMUTH_REQUIRE_DATA("hall-runs");
  for (const EstimatorKind estimator : {EstimatorKind::lamp_ekf, EstimatorKind::fastslam})
    expect_as_good_away(estimator, load_run(test::data_folder() / "hall-runs/hall-000").value());
}

/// A lever arm of 0.1 to 0.5 m, in varying directions.
Eigen::Vector2d lever_arm(std::uint64_t seed, std::uint64_t seeds) {
  const double length_m = 0.1 + 0.4 * static_cast<double>(seed) / static_cast<double>(seeds);
  const double direction_rad = 2.4 * static_cast<double>(seed);
  return length_m * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
}

class Mounts : public testing::TestWithParam<EstimatorKind> {};

// Odometer, landmarks and noise are the same in both cases; only the camera position differs.
TEST_P(Mounts, OfTwentyDrivesAreAsGoodAsOverTheAxle) {
  constexpr int kSeeds = 20;
  const auto by = [&](bool is_away) {
    return replay_seeds(kSeeds, [&](std::uint64_t seed) {
      Scenario scenario = lab(seed, 1);
      if (is_away) scenario.sensor.position_m = lever_arm(seed, kSeeds);
      const auto run = simulated_run(scenario);
      return replayed_by(GetParam(), run, rig_of(run));
    });
  };
  const Runs plain = by(false), known = by(true);
  plain.print(fmt::format("{}, over the axle", name(GetParam())));
  known.print(fmt::format("{}, 0.1 to 0.5 m away", name(GetParam())));
  EXPECT_LE(known.mean_m(), 1.1 * plain.mean_m());
  EXPECT_LE(known.anees(), std::max(3.5, 1.1 * plain.anees()));
}

INSTANTIATE_TEST_SUITE_P(Each, Mounts, testing::Values(EstimatorKind::ekf, EstimatorKind::smoother),
                         [](const auto& use) { return std::string(name(use.param)); });

}  // namespace
}  // namespace azimuth
