#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/principal_axes.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

MotionNoise some_noise(double scale) {
  MotionNoise noise;
  noise.lambda_distance_m = 2.5e-3 * scale;
  noise.lambda_rotation_rad = 1.2e-3 * scale;
  noise.lambda_drift_rad2_per_m = 1e-3 * scale;
  noise.sigma_lateral_m_per_sqrt_m = std::sqrt(1e-3 * scale);
  return noise;
}

std::vector<Control> random_drive(RandomDraws& draws, int segments) {
  std::vector<Control> controls;
  for (int i = 0; i < segments; ++i) controls.push_back(draws.control(0.5, 0.4));
  return controls;
}

Motion accumulated(const std::vector<Control>& controls, const MotionNoise& noise) {
  Motion motion;
  for (const Control& control : controls) append(motion, control, control, noise);
  return motion;
}

TEST(AccumulatedMotion, EqualsPredictingStepByStep) {
  RandomDraws draws(11);
  for (int trial = 0; trial < 200; ++trial) {
    const MotionNoise noise = some_noise(1.0);
    const std::vector<Control> controls = random_drive(draws, draws.integer(1, 30));
    const Pose2 start = draws.pose(10.0);
    const Eigen::Matrix3d P_start = draws.covariance(3, 0.2);

    Pose2 pose = start;
    Eigen::Matrix3d P = P_start;
    for (const Control& control : controls) {  // eq 15 with eq 28, at each segment
      const MotionJacobians jacobians = motion_jacobians(pose.heading_rad, control);
      P = jacobians.G * P * jacobians.G.transpose() + motion_noise(pose.heading_rad, control, noise);
      pose = move(pose, control);
    }
    const MovedPose moved = apply(start, accumulated(controls, noise));
    EXPECT_LT(largest_difference(moved.T_map_body.vector(), pose.vector()), 1e-9);
    EXPECT_LT(largest_difference(moved.G * P_start * moved.G.transpose() + moved.noise, P), 1e-9);
  }
}

TEST(AccumulatedMotion, MayBeJoinedFromParts) {
  RandomDraws draws(13);
  const MotionNoise noise = some_noise(1.0);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<Control> controls = random_drive(draws, 20);
    Motion joined = accumulated({controls.begin(), controls.begin() + 7}, noise);
    append(joined, accumulated({controls.begin() + 7, controls.end()}, noise));
    const Motion whole = accumulated(controls, noise);
    EXPECT_LT(largest_difference(joined.T_start_end.vector(), whole.T_start_end.vector()), 1e-12);
    EXPECT_LT(largest_difference(joined.covariance, whole.covariance), 1e-12);
    EXPECT_NEAR(joined.path_m, whole.path_m, 1e-12);
    EXPECT_NEAR(joined.turned_rad, whole.turned_rad, 1e-12);
  }
}

TEST(AccumulatedMotion, CovarianceIsThatOfSampledDrives) {
  // The noise is small, so that the first-order covariance is accurate; 1 / sqrt(kSamples) is 0.7 %.
  constexpr int kSamples = 20000;
  RandomDraws draws(12);
  const MotionNoise noise = some_noise(1e-2);
  const std::vector<Control> controls = random_drive(draws, 12);
  const Motion motion = accumulated(controls, noise);

  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  for (int sample = 0; sample < kSamples; ++sample) {
    Pose2 pose;
    for (const Control& control : controls) {
      const Eigen::Vector4d sigma = control_variances(control, noise).cwiseSqrt();
      const Control noisy{control.distance_m + draws.normal(sigma(0)), control.first_turn_rad + draws.normal(sigma(1)),
                          control.second_turn_rad + draws.normal(sigma(2)) + draws.normal(sigma(3))};
      const double course_rad = pose.heading_rad + noisy.first_turn_rad;
      const double slip_m = draws.normal(noise.sigma_lateral_m_per_sqrt_m * std::sqrt(std::abs(control.distance_m)));
      pose = move(pose, noisy);
      pose.x_m -= slip_m * std::sin(course_rad);
      pose.y_m += slip_m * std::cos(course_rad);
    }
    Eigen::Vector3d error = pose.vector() - motion.T_start_end.vector();
    error(2) = wrap(error(2));
    sampled += error * error.transpose() / kSamples;
  }
  // Whitened by the predicted covariance, the sampled one is the identity.
  const Eigen::Matrix3d L = motion.covariance.llt().matrixL();
  const Eigen::Matrix3d whitened = L.inverse() * sampled * L.inverse().transpose();
  EXPECT_LT((whitened - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.05) << whitened;
}

TEST(AccumulatedMotion, CountsPathAndTurns) {
  Motion motion;
  EXPECT_FALSE(motion.moved());
  append(motion, {-0.5, 0.2, -0.3}, {-0.5, 0.2, -0.3}, {});
  append(motion, {1.0, 0.1, 0.0}, {1.0, 0.0, 0.0}, {});
  EXPECT_TRUE(motion.moved());
  EXPECT_DOUBLE_EQ(motion.path_m, 1.5);
  EXPECT_DOUBLE_EQ(motion.turned_rad, 0.5);
}

TEST(AccumulatedMotion, ALoopIsChargedForItsLengthNotItsChord) {
  const MotionNoise noise = some_noise(1.0);
  const std::vector<Control> loop(36, Control{0.5, 0.0, kPi / 18.0});
  const Motion motion = accumulated(loop, noise);
  EXPECT_LT(motion.T_start_end.position().norm(), 1e-9);
  const double drift_rad2 = 36 * 0.5 * noise.lambda_drift_rad2_per_m + 2.0 * kPi * noise.lambda_rotation_rad;
  EXPECT_NEAR(motion.covariance(2, 2), drift_rad2, 1e-12);
  EXPECT_GT(eigenvalues(motion.covariance).minCoeff(), 1e-4);
}

TEST(MotionNoise, DirectionsKnownToBeNoiseAreChargedAsStraight) {
  const MotionNoise noise = some_noise(1.0);
  const Control jitter{0.01, 1.0, -1.0}, straight{0.01, 0.0, 0.0};
  const Eigen::Matrix3d Q = motion_noise(0.3, jitter, straight, noise);
  EXPECT_LT(Q.norm(), 0.1 * motion_noise(0.3, jitter, noise).norm());
  EXPECT_NEAR(Q(2, 2), 0.01 * noise.lambda_drift_rad2_per_m, 1e-15);
}

}  // namespace
}  // namespace azimuth
