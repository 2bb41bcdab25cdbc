#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>

#include "sim/world/driver.hpp"
#include "sim/world/sensors.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {

void PrintTo(const Control& control, std::ostream* out) {
  *out << control.distance_m << " m, " << control.first_turn_rad << " and " << control.second_turn_rad << " rad";
}

namespace {

/// Sample covariance of the pose after `control`, in the frame of its start, about the pose without noise.
Eigen::Matrix3d sample_covariance(const Control& control, const OdometerSettings& settings, int count) {
  Random random(11, RandomPurpose::odometry);
  const Pose2 expected = displacement(control);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < count; ++i) {
    const Pose2 pose = disturbed(control, settings, random);
    const Eigen::Vector3d error{pose.x_m - expected.x_m, pose.y_m - expected.y_m,
                                wrap(pose.heading_rad - expected.heading_rad)};
    sum += error * error.transpose();
  }
  return sum / count;
}

class OdometerNoise : public testing::TestWithParam<Control> {};

// Compares the simulated noise with the covariance that all filters here assume (mathematics I.3).
TEST_P(OdometerNoise, HasTheCovarianceOfTheMotionModel) {
  OdometerSettings settings;
  settings.lambda_drift_rad2_per_m = 1e-3;
  settings.sigma_lateral_m_per_sqrt_m = 0.03;
  const MotionNoise noise{settings.lambda_distance_m, settings.lambda_rotation_rad, settings.lambda_drift_rad2_per_m,
                          settings.sigma_lateral_m_per_sqrt_m};
  const Eigen::Matrix3d expected = motion_noise(0.0, GetParam(), noise);
  const Eigen::Matrix3d sampled = sample_covariance(GetParam(), settings, 40000);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double scale = std::sqrt(expected(row, row) * expected(column, column));
      EXPECT_NEAR(sampled(row, column), expected(row, column), 0.05 * scale + 1e-12) << row << "," << column;
    }
}

INSTANTIATE_TEST_SUITE_P(Controls, OdometerNoise,
                         testing::Values(Control{1.0, 0.0, 0.0}, Control{1.0, 0.6, -0.3}, Control{0.0, 0.4, 1.2},
                                         Control{-0.5, 0.2, 0.1}),
                         test::PrintedName());

TEST(Odometer, StandsStillWithoutNoise) {
  Random random(1, RandomPurpose::odometry);
  EXPECT_EQ(disturbed(Control{}, OdometerSettings{}, random), Pose2{});
}

TEST(Odometer, RawReadingsAreUndoneByTheCalibration) {
  OdometerSettings settings;
  settings.scale_distance = 0.965;
  settings.scale_turn = 0.945;
  settings.drift_rad_per_m = -0.05;
  const Control control{1.2, 0.3, -0.1};
  const Control reading = raw(control, settings);
  const double distance_m = settings.scale_distance * reading.distance_m;
  EXPECT_NEAR(distance_m, control.distance_m, 1e-12);
  const double turn_rad = settings.scale_turn * (reading.first_turn_rad + reading.second_turn_rad);
  EXPECT_NEAR(turn_rad + settings.drift_rad_per_m * distance_m, control.first_turn_rad + control.second_turn_rad,
              1e-12);
}

}  // namespace
}  // namespace azimuth
