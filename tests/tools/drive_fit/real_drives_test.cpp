// Tests the calibration of recorded drives that starts from an uncalibrated rig.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "settings/configured_estimator.hpp"
#include "tests/support/data.hpp"
#include "tests/support/drive_of.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {
namespace {

class RealDrives : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    AZIMUTH_REQUIRE_DATA(GetParam());
    run_ = *load_run(test::data_folder() / GetParam());
  }
  double rmse_m(const Rig& rig) const {
    Configuration configuration;
    configuration.smoother.doubt_rig = false;  // so that the errors of the rig show in the result
    const ReplayResult result = replay(run_, rig, configured_estimator(rig, configuration, nullptr), StageSettings{});
    return evaluate(replay_record(run_, rig, "", 1, result)).position_m.rmse;
  }
  azimuth::Run run_;
};

TEST_P(RealDrives, CalibrateTheirOdometryWithoutTruth) {
  // GIVEN a real robot's drive and an uncalibrated rig: turn scale 1, no drift, no lag
  const Rig own = test::rig_of_run(run_);
  Rig rig = own;
  rig.odometry.scale_turn = 1.0;
  rig.odometry.drift_rad_per_m = rig.odometry.lag_s = 0.0;
  // WHEN bearings alone calibrate it
  const OdometryCalibration found = calibrate_odometry(test::drive_of(run_, rig), rig, {});
  const double own_m = rmse_m(own), found_m = rmse_m(found.solution.guess.rig);
  fmt::print("{}: turn {:.4f} +- {:.4f}, drift {:.4f} +- {:.4f}, lag {:.3f} +- {:.3f}; replay {:.3f} m, own {:.3f} m\n",
             GetParam(), found.turn.value, found.turn.sigma, found.drift.value, found.drift.sigma, found.lag.value,
             found.lag.sigma, found_m, own_m);
  for (const OdometryNoise::Told& noise : found.noise.sorts)
    fmt::print("  {:.3g} +- {:.2f}\n", noise.variance, noise.sigma_relative);
  // THEN the result agrees with the rig that was fitted to the truth, and its replay is as good
  EXPECT_NEAR(found.turn.value, own.odometry.scale_turn, 0.02);
  EXPECT_NEAR(found.drift.value, own.odometry.drift_rad_per_m, 0.015);
  EXPECT_LT(found_m, 1.1 * own_m);
}

TEST(NoiseOfRealDrives, KeepsTheirEstimatesHonest) {
  AZIMUTH_REQUIRE_DATA("lostwoods-c");
  const auto run = *load_run(test::data_folder() / "lostwoods-c");
  const auto anees = [&](const Rig& rig) {
    Configuration configuration;
    configuration.smoother.doubt_rig = false;
    const ReplayResult result = replay(run, rig, configured_estimator(rig, configuration, nullptr), StageSettings{});
    return evaluate(replay_record(run, rig, "", 1, result)).consistency.anees;
  };
  const Rig rig = test::rig_of_run(run);
  const OdometryCalibration found = calibrate_odometry(test::drive_of(run, rig), rig, {});
  const OdometryRig &said = rig.odometry, &written = found.solution.guess.rig.odometry;
  const double before = anees(rig), after = anees(found.solution.guess.rig);
  fmt::print("lostwoods-c: lambda_rotation {:.2g} (said {:.2g}, likeliest {:.2g}), ANEES {:.2f}, before {:.2f}\n",
             written.lambda_rotation_rad, said.lambda_rotation_rad, found.noise.of(NoiseSort::rotation).variance, after,
             before);
  EXPECT_GE(written.lambda_rotation_rad, 0.999 * said.lambda_rotation_rad / 9.0);
  EXPECT_LT(after, 1.5 * before);
}

INSTANTIATE_TEST_SUITE_P(Mrclam, RealDrives, testing::Values("mrclam6-robot1", "mrclam6-robot2", "mrclam6-robot3"),
                         [](const auto& use) { return std::string(use.param).substr(8); });

}  // namespace
}  // namespace azimuth
