#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/fastslam/lamp_update.hpp"
#include "slam/fastslam/lamp_view.hpp"
#include "slam/fastslam/ray_fit.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kHeight_m = 1.8;

Eigen::Vector3d random_lamp(RandomDraws& draws) {
  const Eigen::Vector2d flat = draws.point(12.0);
  return {flat.x(), flat.y(), draws.uniform(3.0, 9.0)};
}

Eigen::Vector2d direction_from(const Eigen::Vector3d& pose, const Eigen::Vector3d& p_map) {
  const Viewpoint from(pose, kHeight_m);
  return direction_of(view(from, p_map), from.heading_rad);
}

template <class Function>
Eigen::Matrix<double, 2, 3> differences(const Function& h, const Eigen::Vector3d& at) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 2, 3> jacobian;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    const Eigen::Vector2d change = h(at + step) - h(at - step);
    jacobian.col(i) << wrap(change.x()) / (2.0 * kStep), change.y() / (2.0 * kStep);
  }
  return jacobian;
}

TEST(LampView, JacobiansAgreeWithDifferences) {
  RandomDraws draws(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Vector3d pose = draws.pose(10.0).vector(), lamp = random_lamp(draws);
    const LampView v = view(Viewpoint(pose, kHeight_m), lamp);
    if (v.rho_m < 0.3) continue;  // the azimuth changes too fast for numeric differences
    const auto H_x = differences([&](const Eigen::Vector3d& x) { return direction_from(x, lamp); }, pose);
    const auto H_m = differences([&](const Eigen::Vector3d& m) { return direction_from(pose, m); }, lamp);
    EXPECT_LT((v.H_x() - H_x).norm(), 1e-6);
    EXPECT_LT((v.H_m() - H_m).norm(), 1e-6);
  }
}

TEST(LampView, PackedProductsAreThoseOfTheMatrices) {
  RandomDraws draws(2);
  for (int trial = 0; trial < 200; ++trial) {
    const LampView v = view(Viewpoint(draws.pose(10.0), kHeight_m), random_lamp(draws));
    const Eigen::Matrix3d P = draws.covariance(3, 0.3);
    EXPECT_LT((v.of_pose(Symmetric3::of(P)).matrix() - v.H_x() * P * v.H_x().transpose()).norm(), 1e-9);
    EXPECT_LT((v.of_point(Symmetric3::of(P)).matrix() - v.H_m() * P * v.H_m().transpose()).norm(), 1e-9);
  }
}

TEST(LampView, InnovationIsTheWrappedDifference) {
  RandomDraws draws(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const Viewpoint from(draws.pose(10.0), kHeight_m);
    const Eigen::Vector3d lamp = random_lamp(draws);
    const LampView v = view(from, lamp);
    const double azimuth = draws.uniform(-kPi, kPi), zenith = draws.uniform(0.0, 1.5);
    const Eigen::Vector2d nu = innovation(v, from, make_sighting(azimuth, zenith, {1.0, 0.0, 1.0}));
    const Eigen::Vector2d z = direction_of(v, from.heading_rad);
    EXPECT_NEAR(wrap(nu.x() - wrap(azimuth - z.x())), 0.0, 1e-12);
    EXPECT_NEAR(nu.y(), zenith - z.y(), 1e-12);
  }
}

TEST(LampView, SmallAnglesAreExact) {
  const double other = 2.5;  // a large angle in the other component must not disturb the small one
  for (double angle = -0.2; angle < 0.2; angle += 1e-4) {
    const Eigen::Vector2d angles =
        small_atan2(Both{3.0 * std::sin(angle), std::sin(other)}, Both{3.0 * std::cos(angle), std::cos(other)});
    EXPECT_NEAR(angles.x(), angle, 1e-16);
    EXPECT_NEAR(angles.y(), other, 1e-15);
  }
}

TEST(LampView, StraightBelowALampIsFinite) {
  const Viewpoint from(Pose2{1.0, 2.0, 0.3}, kHeight_m);
  const LampView v = view(from, {1.0, 2.0, 6.5});
  EXPECT_TRUE(v.H_x().allFinite() && v.H_m().allFinite());
}

TEST(SemidefiniteFactor, ReproducesSingularCovariances) {
  RandomDraws draws(4);
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::Matrix3d P = draws.covariance(3, 0.5);
    if (trial % 3 == 1) P.row(1).setZero(), P.col(1).setZero();
    if (trial % 3 == 2) P = P.col(0) * P.col(0).transpose();
    const Eigen::Matrix3d L = semidefinite_factor(Symmetric3::of(P));
    EXPECT_LT((L * L.transpose() - P).norm(), 1e-9) << trial;
  }
  EXPECT_EQ(semidefinite_factor(Symmetric3{}), Eigen::Matrix3d::Zero());
}

TEST(LampUpdate, IsTheKalmanUpdate) {
  RandomDraws draws(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Viewpoint from(draws.pose(5.0), kHeight_m);
    Eigen::Vector3d mu = random_lamp(draws);
    const Eigen::Matrix3d P = draws.covariance(3, 0.2);
    Symmetric3 Sigma = Symmetric3::of(P);
    const LampView v = view(from, mu);
    const Eigen::Vector2d z =
        direction_of(v, from.heading_rad) + Eigen::Vector2d(draws.normal(0.02), draws.normal(0.02));
    const Eigen::Matrix2d Q = draws.covariance(2, 0.02);
    const LampSighting seen = make_sighting(wrap(z.x()), z.y(), Symmetric2::of(Q));
    const Eigen::Matrix<double, 3, 2> K = P * v.H_m().transpose() * (v.H_m() * P * v.H_m().transpose() + Q).inverse();
    const Eigen::Vector3d expected = mu + K * innovation(v, from, seen);
    correct(from, seen, mu, Sigma);
    EXPECT_LT((mu - expected).norm(), 1e-9);
    EXPECT_LT((Sigma.matrix() - (P - K * v.H_m() * P)).norm(), 1e-9);
  }
}

/// The scatter of fits to noisy rays agrees with their covariance.
TEST(RayFit, CovarianceIsHonest) {
  RandomDraws draws(6);
  constexpr int kTrials = 400;
  const Eigen::Vector3d lamp(2.0, 3.0, 6.5);
  const double sigma = 0.01;
  double nees = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<LampSighting> sightings;
    std::vector<Ray> rays;
    for (int i = 0; i < 8; ++i) {
      const Viewpoint from(Pose2{0.5 * i, 0.1 * i, 0.05 * i}, kHeight_m);
      const Eigen::Vector2d z = direction_of(view(from, lamp), from.heading_rad);
      sightings.push_back(
          make_sighting(z.x() + draws.normal(sigma), z.y() + draws.normal(sigma), {sigma * sigma, 0.0, sigma * sigma}));
      rays.push_back({from, nullptr});
    }
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i].seen = &sightings[i];
    const auto fit = fit_point(rays, std::vector<Symmetric3>(rays.size()), {1.0, 2.0, 5.0});
    ASSERT_TRUE(fit);
    const Eigen::Vector3d error = fit->p_map - lamp;
    nees += error.dot(fit->covariance.matrix().inverse() * error) / kTrials;
  }
  EXPECT_NEAR(nees, 3.0, 0.5);
}

TEST(RayFit, OneRayIsNoPoint) {
  const LampSighting seen = make_sighting(0.3, 0.5, {1e-4, 0.0, 1e-4});
  const std::vector<Ray> rays(3, Ray{Viewpoint(Pose2{}, kHeight_m), &seen});
  EXPECT_FALSE(fit_point(rays, std::vector<Symmetric3>(3), {1.0, 0.0, 40.0}));
}

}  // namespace
}  // namespace azimuth
