#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/fastslam/lamp_update.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kLowCamera_m = 1.8;
constexpr int kLamps = 5;

/// Adding the sightings one after the other must equal one large Gaussian: the joint density of all innovations, and
/// the pose given all of them.
TEST(PoseProposal, OneAfterTheOtherIsAllAtOnce) {
  RandomDraws draws(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Viewpoint x_hat(draws.pose(5.0), kLowCamera_m);
    const Eigen::Matrix3d R = draws.covariance(3, 0.05);
    PoseProposal proposal(x_hat.pose(), Symmetric3::of(R));
    Eigen::MatrixXd H(2 * kLamps, 3), S = Eigen::MatrixXd::Zero(2 * kLamps, 2 * kLamps);
    Eigen::VectorXd nu(2 * kLamps);
    for (int i = 0; i < kLamps; ++i) {
      const Eigen::Vector2d flat = draws.point(8.0);
      const LampView v = view(x_hat, {flat.x(), flat.y(), 6.5});
      const Eigen::Matrix2d Q = draws.covariance(2, 0.03);
      const Eigen::Vector2d innovation(draws.normal(0.05), draws.normal(0.05));
      proposal.add(v, innovation, Symmetric2::of(Q));
      H.middleRows<2>(2 * i) = v.H_x();
      S.block<2, 2>(2 * i, 2 * i) = Q;
      nu.segment<2>(2 * i) = innovation;
    }
    S += H * R * H.transpose();
    const Eigen::MatrixXd K = R * H.transpose() * S.inverse();
    const Eigen::Vector3d mean = x_hat.pose() + K * nu;
    EXPECT_NEAR((proposal.mean().head<2>() - mean.head<2>()).norm(), 0.0, 1e-9);
    EXPECT_NEAR(wrap(proposal.mean().z() - mean.z()), 0.0, 1e-9);
    EXPECT_LT((proposal.covariance().matrix() - (R - K * H * R)).norm(), 1e-10);
    const double log_density =
        -0.5 * (nu.dot(S.inverse() * nu) + std::log(S.determinant()) + 2.0 * kLamps * std::log(2.0 * kPi));
    EXPECT_NEAR(proposal.log_likelihood(), log_density, 1e-6);
  }
}

TEST(PoseProposal, AtStandstillNothingMoves) {
  const Viewpoint x_hat(Pose2{1.0, 2.0, 0.5}, kLowCamera_m);
  PoseProposal proposal(x_hat.pose(), Symmetric3{});
  proposal.add(view(x_hat, {3.0, 4.0, 6.5}), {0.1, -0.1}, {1e-4, 0.0, 1e-4});
  EXPECT_EQ(proposal.mean(), x_hat.pose());
  EXPECT_TRUE(std::isfinite(proposal.log_likelihood()));
}

}  // namespace
}  // namespace azimuth
