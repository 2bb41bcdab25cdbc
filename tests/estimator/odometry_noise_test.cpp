// The noise of odometry over a drive must not depend on the rate and the resolution of the odometer.

#include <cmath>
#include <gtest/gtest.h>

#include "sim/world/simulate.hpp"
#include "slam/estimator/odometry_track.hpp"

namespace azimuth {
namespace {

OdometryRig noisy_rig() {
  OdometryRig rig;
  rig.lambda_drift_rad2_per_m = 1e-3;
  rig.sigma_lateral_m_per_sqrt_m = 0.02;
  return rig;
}

/// The odometry of one lap, without noise.
World exact_lap(double odometry_period_s) {
  Scenario scenario = lab(1, 1);
  scenario.odometer = {0.0, 0.0, 0.0, 0.0};
  scenario.sampling.odometry_period_s = odometry_period_s;
  return simulate(scenario);
}

Motion motion_of(const std::vector<OdometryReading>& odometry, const OdometryRig& rig) {
  OdometryTrack track(rig);
  for (const OdometryReading& reading : odometry) track.add(reading);
  return track.advance_to(track.newest()).motion;
}

void expect_same_noise(const Motion& motion, const Motion& expected, double tolerance) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(motion.covariance(i, i) / expected.covariance(i, i), 1.0, tolerance) << "entry " << i;
}

TEST(OdometryNoise, IsThatOfTheDriveAndNotOfTheRate) {
  const Motion at_10_hz = motion_of(exact_lap(0.1).odometry, noisy_rig());
  const Motion at_100_hz = motion_of(exact_lap(0.01).odometry, noisy_rig());
  const Motion at_2_hz = motion_of(exact_lap(0.5).odometry, noisy_rig());
  expect_same_noise(at_100_hz, at_10_hz, 0.04);
  expect_same_noise(at_2_hz, at_10_hz, 0.1);
  EXPECT_NEAR(at_100_hz.path_m / at_10_hz.path_m, 1.0, 0.01);
}

TEST(OdometryNoise, IsWhatTheModelChargesForAStraightDrive) {
  std::vector<OdometryReading> straight;
  for (int i = 0; i <= 400; ++i) straight.push_back({stamp_from_us(i * 50000), 0, 0, Pose2{0.025 * i, 0.0, 0.0}});
  const OdometryRig rig = noisy_rig();
  const Motion motion = motion_of(straight, rig);
  const double length_m = 10.0;
  EXPECT_NEAR(motion.covariance(2, 2), rig.lambda_drift_rad2_per_m * length_m, 1e-9);
  EXPECT_NEAR(motion.covariance(0, 0), rig.lambda_distance_m * length_m, 1e-9);
  // Across the path: slip, and the integral of the heading's random walk.
  const double slip_m2 = rig.sigma_lateral_m_per_sqrt_m * rig.sigma_lateral_m_per_sqrt_m * length_m;
  const double drift_m2 = rig.lambda_drift_rad2_per_m * std::pow(length_m, 3) / 3.0;
  EXPECT_NEAR(motion.covariance(1, 1) / (slip_m2 + drift_m2), 1.0, 0.01);
}

double rounded_to(double value, double resolution) { return std::round(value / resolution) * resolution; }

std::vector<OdometryReading> quantised(std::vector<OdometryReading> odometry, double resolution_m) {
  for (OdometryReading& reading : odometry) {
    reading.T_odom_body.x_m = rounded_to(reading.T_odom_body.x_m, resolution_m);
    reading.T_odom_body.y_m = rounded_to(reading.T_odom_body.y_m, resolution_m);
  }
  return odometry;
}

/// Ten metres in an oblique direction, so that both coordinates are rounded all the time.
std::vector<OdometryReading> slanting_drive(double rate_hz, double speed_m_per_s) {
  std::vector<OdometryReading> odometry;
  const double heading_rad = 0.3, pitch_m = speed_m_per_s / rate_hz;
  for (int i = 0; i * pitch_m <= 10.0; ++i)
    odometry.push_back({Stamp{duration_from_seconds(i / rate_hz)},
                        0,
                        0,
                        {i * pitch_m * std::cos(heading_rad), i * pitch_m * std::sin(heading_rad), heading_rad}});
  return odometry;
}

TEST(OdometryNoise, ResolutionOfAMillimetreDoesNotInflateTheHeading) {
  struct Odometer {
    double rate_hz, speed_m_per_s;
  };
  for (const auto& [rate_hz, speed_m_per_s] : {Odometer{10, 0.5}, {10, 0.1}, {100, 0.5}, {100, 0.1}}) {
    const std::vector<OdometryReading> exact = slanting_drive(rate_hz, speed_m_per_s);
    const double heading_rad2 = motion_of(exact, noisy_rig()).covariance(2, 2);
    const double coarse_rad2 = motion_of(quantised(exact, 1e-3), noisy_rig()).covariance(2, 2);
    std::printf("%g Hz, %g m/s: heading variance over 10 m %g, quantised %g\n", rate_hz, speed_m_per_s, heading_rad2,
                coarse_rad2);
    EXPECT_LT(coarse_rad2, 1.3 * heading_rad2);
  }
}

TEST(OdometryNoise, FoldingAtCapacityDoesNotChangeTheMotion) {
  // Every reading closes a segment, so the motion is the sum over the readings, regardless of the folding in storage.
  std::vector<OdometryReading> odometry;
  Pose2 T_odom_body;
  const Control control{0.03, 0.0015, 0.0015};  // an arc with the turn split evenly, as the noise model assumes
  for (std::size_t i = 0; i < 3 * OdometryTrack::kCapacity; ++i) {
    odometry.push_back({stamp_from_us(static_cast<std::int64_t>(i) * 10000), i, 0, T_odom_body});
    T_odom_body = move(T_odom_body, control);
  }
  const OdometryRig rig = noisy_rig();
  const MotionNoise noise{rig.lambda_distance_m, rig.lambda_rotation_rad, rig.lambda_drift_rad2_per_m,
                          rig.sigma_lateral_m_per_sqrt_m};
  Motion expected;
  for (std::size_t i = 1; i < odometry.size(); ++i) append(expected, control, control, noise);
  const Motion folded = motion_of(odometry, rig);
  EXPECT_NEAR((folded.T_start_end.vector() - expected.T_start_end.vector()).norm(), 0.0, 1e-8);
  EXPECT_NEAR(folded.path_m, expected.path_m, 1e-8);
  EXPECT_LT((folded.covariance - expected.covariance).norm(), 1e-6 * expected.covariance.norm());
}

TEST(OdometryNoise, AfterFoldingTheNewestInstantsCanStillBeAskedFor) {
  OdometryTrack track(noisy_rig());
  for (std::size_t i = 0; i < 2 * OdometryTrack::kCapacity; ++i)
    track.add({stamp_from_us(static_cast<std::int64_t>(i) * 10000), i, 0, {0.01 * static_cast<double>(i), 0.0, 0.0}});
  EXPECT_GT(track.oldest(), stamp_from_us(0));
  const Stamp middle = track.oldest() + Duration{5000};
  EXPECT_NEAR(track.advance_to(middle).T_odom_body.x_m, to_seconds(middle), 1e-9);
  EXPECT_NEAR(track.advance_to(track.newest()).T_odom_body.x_m, to_seconds(track.newest()), 1e-9);
}

TEST(OdometryNoise, StandingStillCostsNothing) {
  std::vector<OdometryReading> odometry;
  for (int i = 0; i < 5000; ++i) odometry.push_back({stamp_from_us(i * 100000), 0, 0, {1.0, 2.0, 0.5}});
  const Motion motion = motion_of(odometry, noisy_rig());
  EXPECT_FALSE(motion.moved());
  EXPECT_EQ(motion.covariance, Eigen::Matrix3d::Zero());
}

}  // namespace
}  // namespace azimuth
