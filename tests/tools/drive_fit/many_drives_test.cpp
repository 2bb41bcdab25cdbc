// Drives with errors that are known, drawn anew for each: what is found lies within two of its own standard deviations.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/drive_of.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kDrives = 20, kMustHold = 18;

Scenario uncalibrated(Scenario scenario, Random& random) {
  scenario.odometer.scale_turn = random.uniform(0.85, 1.15);
  scenario.odometer.drift_rad_per_m = random.uniform(-0.05, 0.05);
  scenario.odometer.lag_s = random.uniform(-0.3, 0.3);
  return scenario;
}

/// As its maker left it: noise as it is, nothing calibrated.
Rig as_it_came(const Run& run) {
  Rig rig = test::rig_of_run(run);
  rig.odometry.scale_turn = 1.0;
  rig.odometry.drift_rad_per_m = 0.0;
  rig.odometry.lag_s = 0.0;
  return rig;
}

struct Within {
  int turn = 0, drift = 0, lag = 0;
};

Within count(const std::function<Scenario(std::uint64_t)>& world) {
  Within within;
  for (std::uint64_t seed = 1; seed <= kDrives; ++seed) {
    Random random(seed, RandomPurpose::scene);
    const Scenario scenario = uncalibrated(world(100 + seed), random);
    const auto run = simulated_run(scenario);
    const Rig rig = as_it_came(run);
    const OdometryCalibration found = calibrate_odometry(test::drive_of(run, rig), rig, {});
    const auto sigmas = [](const FoundNumber& number, double truth) { return (number.value - truth) / number.sigma; };
    const double turn = sigmas(found.turn, scenario.odometer.scale_turn),
                 drift = sigmas(found.drift, scenario.odometer.drift_rad_per_m),
                 lag = sigmas(found.lag, scenario.odometer.lag_s);
    fmt::print("{:3d}  turn {:6.2f} of {:.4f}  drift {:6.2f} of {:.4f}  lag {:6.2f} of {:.4f}\n", seed, turn,
               found.turn.sigma, drift, found.drift.sigma, lag, found.lag.sigma);
    within.turn += found.turn.told && std::abs(turn) < 2.0 ? 1 : 0;
    within.drift += found.drift.told && std::abs(drift) < 2.0 ? 1 : 0;
    within.lag += found.lag.told && std::abs(lag) < 2.0 ? 1 : 0;
  }
  return within;
}

TEST(ManyDrives, OfALabAreWithinTwoStandardDeviations) {
  const Within within = count([](std::uint64_t seed) { return lab(seed, 2); });
  EXPECT_GE(within.turn, kMustHold);
  EXPECT_GE(within.drift, kMustHold);
  EXPECT_GE(within.lag, kMustHold);
}

TEST(ManyDrives, AmongScatteredLandmarksAreWithinTwoStandardDeviations) {
  const Within within = count([](std::uint64_t seed) { return scattered(seed); });
  EXPECT_GE(within.turn, kMustHold);
  EXPECT_GE(within.drift, kMustHold);
  EXPECT_GE(within.lag, kMustHold);
}

}  // namespace
}  // namespace azimuth
