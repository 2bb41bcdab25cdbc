// Tests the consistency of the drive calibration: over many drives with known random errors, the results lie within two
// of their own standard deviations.

#include <cmath>
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

/// The rig of the run without its calibration; the noise stays as it is.
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

// The camera is up to half a metre from the origin of the body frame and turned by up to 0.2 rad.
TEST(ManyDrives, TellWhereTheCameraStands) {
  int within = 0, near = 0, aligned = 0;
  for (std::uint64_t seed = 1; seed <= kDrives; ++seed) {
    Random random(seed, RandomPurpose::scene);
    Scenario scenario = lab(200 + seed, 2);
    const double direction_rad = random.uniform(-kPi, kPi), length_m = random.uniform(0.1, 0.5);
    scenario.sensor.position_m = length_m * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
    scenario.sensor.yaw_offset_rad = random.uniform(-0.2, 0.2);
    const auto run = simulated_run(scenario);
    Rig rig = test::rig_of_run(run);
    rig.camera.position_m = {};
    rig.camera.yaw_offset_rad = 0.0;
    const HeadingCalibration found = calibrate_heading(test::drive_of(run, rig), rig, {});
    const Eigen::Vector2d off_m = Eigen::Vector2d(found.ahead.value, found.left.value) - scenario.sensor.position_m;
    const double yaw_deg = rad_to_degrees(wrap(found.yaw.value - scenario.sensor.yaw_offset_rad));
    const bool holds = found.ahead.told && std::abs(off_m.x()) < 2.0 * found.ahead.sigma &&
                       std::abs(off_m.y()) < 2.0 * found.left.sigma;
    fmt::print("{:3d}  off by ({:6.3f}, {:6.3f}) m, +- ({:.3f}, {:.3f}), and by {:5.2f} degrees, +- {:.2f}{}\n", seed,
               off_m.x(), off_m.y(), found.ahead.sigma, found.left.sigma, yaw_deg, rad_to_degrees(found.yaw.sigma),
               found.ahead.told ? "" : ": not told");
    within += holds ? 1 : 0;
    near += found.ahead.told && off_m.norm() <= 0.02 ? 1 : 0;
    aligned += std::abs(yaw_deg) <= 0.3 ? 1 : 0;
  }
  fmt::print("of {}: {} within two sigma, {} within two centimetres, {} within 0.3 degrees\n", kDrives, within, near,
             aligned);
  EXPECT_GE(within, kMustHold);
  EXPECT_GE(near, kMustHold);
  EXPECT_GE(aligned, kMustHold);
}

}  // namespace
}  // namespace azimuth
