// The measurement model of a lamp above the robot: every Jacobian is compared with numeric differentiation, the limits
// straight above and infinitely high are tested, and an inverse height agrees with the point that it describes.

#include <gtest/gtest.h>

#include "slam/ekf/lamp_ekf.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr int kTrials = 250;
constexpr double kCameraHeight_m = 1.8, kLowest_m = 0.2;

Pose2 pose_of(const Eigen::VectorXd& x) { return {x(0), x(1), x(2)}; }
InverseHeight lamp_of(const Eigen::VectorXd& x) { return {x.segment<2>(3), x.segment<2>(5), x(7)}; }

Eigen::VectorXd random_inverse_height(RandomDraws& draws, double extent_m) {
  Eigen::VectorXd x(8);
  x << draws.pose(extent_m).vector(), draws.point(extent_m), draws.point(4.0), draws.uniform(-0.1, 0.8);
  return x;
}

TEST(InverseHeightModel, JacobiansAtIdentityTinyAndRandom) {
  RandomDraws draws(71);
  const auto offset = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(predict_offset(pose_of(x), lamp_of(x)).m);
  };
  for (int i = 0; i < kTrials; ++i) {
    Eigen::VectorXd x = random_inverse_height(draws, i % 2 == 0 ? 1e-6 : 20.0);
    if (i == 0) x.setZero();
    const auto predicted = predict_offset(pose_of(x), lamp_of(x));
    const Eigen::MatrixXd numeric = numeric_jacobian(offset, x);
    EXPECT_LT(largest_difference(predicted.by_pose, numeric.leftCols<3>()), kJacobianTolerance);
    EXPECT_LT(largest_difference(predicted.by_lamp, numeric.rightCols<5>()), kJacobianTolerance);
  }
}

TEST(LampPointModel, JacobiansAtIdentityTinyAndRandom) {
  RandomDraws draws(72);
  const auto offset = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(predict_offset(pose_of(x), Eigen::Vector3d(x.tail<3>()), kCameraHeight_m, kLowest_m)->m);
  };
  for (int i = 0; i < kTrials; ++i) {
    const double extent_m = i % 2 == 0 ? 1e-6 : 20.0;
    Eigen::VectorXd x(6);
    x << draws.pose(extent_m).vector(), draws.point(extent_m), kCameraHeight_m + draws.uniform(0.8, 8.0);
    const auto predicted = predict_offset(pose_of(x), Eigen::Vector3d(x.tail<3>()), kCameraHeight_m, kLowest_m);
    const Eigen::MatrixXd numeric = numeric_jacobian(offset, x);
    EXPECT_LT(largest_difference(predicted->by_pose, numeric.leftCols<3>()), kJacobianTolerance);
    EXPECT_LT(largest_difference(predicted->by_lamp, numeric.rightCols<3>()), kJacobianTolerance);
  }
}

TEST(LampPointModel, IsRefusedAtTheCamerasHeightAndBelow) {
  EXPECT_FALSE(predict_offset({}, {1.0, 0.0, kCameraHeight_m + 0.19}, kCameraHeight_m, kLowest_m));
  EXPECT_FALSE(predict_offset({}, {1.0, 0.0, -3.0}, kCameraHeight_m, kLowest_m));
  EXPECT_TRUE(predict_offset({}, {1.0, 0.0, kCameraHeight_m + 0.21}, kCameraHeight_m, kLowest_m));
}

TEST(InverseHeightModel, IsThatOfThePointItDescribes) {
  RandomDraws draws(73);
  for (int i = 0; i < kTrials; ++i) {
    Eigen::VectorXd x = random_inverse_height(draws, 10.0);
    x(7) = draws.uniform(0.05, 2.0);
    const Eigen::Vector3d point = point_of(lamp_of(x), kCameraHeight_m);
    const auto by_point = predict_offset(pose_of(x), point, kCameraHeight_m, kLowest_m);
    const auto by_inverse = predict_offset(pose_of(x), lamp_of(x));
    ASSERT_TRUE(by_point);
    EXPECT_LT((by_point->m - by_inverse.m).norm(), 1e-11);
    EXPECT_LT(largest_difference(by_point->by_pose, by_inverse.by_pose), 1e-11);
    Eigen::Matrix<double, 3, 5> jacobian;
    point_of(lamp_of(x), kCameraHeight_m, &jacobian);
    EXPECT_LT(largest_difference(by_point->by_lamp * jacobian, by_inverse.by_lamp), 1e-9);
    const auto as_point = [&](const Eigen::VectorXd& lamp) {
      return Eigen::VectorXd(point_of({lamp.segment<2>(0), lamp.segment<2>(2), lamp(4)}, kCameraHeight_m));
    };
    if (x(7) < 0.2) continue;
    EXPECT_LT(largest_difference(jacobian, numeric_jacobian(as_point, x.tail<5>(), {}, 1e-4)), kJacobianTolerance);
  }
}

TEST(InverseHeightModel, InfinitelyHighIsTheDirectionItself) {
  const InverseHeight lamp{{3.0, -2.0}, {0.4, 0.7}, 0.0};
  EXPECT_LT((predict_offset({100.0, 50.0, 0.0}, lamp).m - lamp.offset_per_metre).norm(), 1e-15);
}

// ---- A direction and the plane it is compared in ----

Eigen::Vector2d offset_of(double azimuth_rad, double zenith_rad) {
  return std::tan(zenith_rad) * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad));
}

TEST(TangentDirection, JacobiansMatchFromTheZenithToTheHorizon) {
  RandomDraws draws(74);
  for (int i = 0; i < kTrials; ++i) {
    const double zenith_rad = i % 5 == 0 ? draws.uniform(0.0, 1e-6) : draws.uniform(0.0, 1.3);
    const TangentDirection seen(draws.uniform(-kPi, kPi), zenith_rad, {1e-4, 1e-4});
    const Eigen::Vector2d m = offset_of(draws.uniform(-kPi, kPi), draws.uniform(0.0, 1.3));
    const auto residual = seen.against(m);
    const auto prediction = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd(-seen.against(Eigen::Vector2d(at))->innovation);
    };
    // Farther off the derivative grows without bound.
    if (!residual || residual->innovation.norm() > 2.0) continue;
    EXPECT_LT(largest_difference(residual->by_offset, numeric_jacobian(prediction, m)), kJacobianTolerance);
  }
}

TEST(TangentDirection, ErrorsAreThoseOfAzimuthAndZenith) {
  RandomDraws draws(75);
  constexpr double kSmall_rad = 1e-5;
  for (int i = 0; i < kTrials; ++i) {
    const double azimuth_rad = draws.uniform(-kPi, kPi), zenith_rad = draws.uniform(0.05, 1.4);
    const TangentDirection seen(azimuth_rad, zenith_rad, {4e-4, 1e-4});
    EXPECT_LT(seen.against(seen.offset_per_metre())->innovation.norm(), 1e-12);
    const Eigen::Vector2d beside = offset_of(azimuth_rad - kSmall_rad, zenith_rad);
    const Eigen::Vector2d above = offset_of(azimuth_rad, zenith_rad - kSmall_rad);
    EXPECT_NEAR(seen.against(beside)->innovation.x(), kSmall_rad * std::sin(zenith_rad), 1e-9);
    EXPECT_NEAR(seen.against(above)->innovation.y(), kSmall_rad, 1e-9);
    EXPECT_NEAR(seen.variance().x(), 4e-4 * std::pow(std::sin(zenith_rad), 2), 1e-15);
    EXPECT_EQ(seen.variance().y(), 1e-4);
    // The noise of the first sighting must agree with the noise of all later ones.
    const Eigen::Matrix2d product = seen.against(seen.offset_per_metre())->by_offset * seen.offset_by_error();
    EXPECT_LT((product - Eigen::Matrix2d::Identity()).norm(), 1e-9);
  }
}

TEST(TangentDirection, OfWhatIsARightAngleAwayThereIsNoResidual) {
  const TangentDirection seen(0.0, 1.2, {1e-4, 1e-4});
  EXPECT_FALSE(seen.against(offset_of(kPi, 1.2)));
  EXPECT_TRUE(seen.against(offset_of(0.0, 1.4)));
}

}  // namespace
}  // namespace azimuth
