// Prediction and landmark initialisation by the EKF with the camera's yaw as a state. Covariances are compared with
// those from numeric derivatives of the whole transformation.

#include "slam/ekf/bearing_ekf.hpp"

#include <array>
#include <gtest/gtest.h>
#include <numeric>

#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

BearingEkfSettings with_yaw_state() {
  BearingEkfSettings settings;
  settings.yaw_offset_rad = 0.2;
  settings.estimate_yaw = true;
  settings.sigma_yaw_rad = 0.05;
  return settings;
}
constexpr Index kYaw = 3;  // the yaw's entry follows the robot's pose

Eigen::MatrixXd covariance_of(const BearingEkf& ekf, const std::vector<Index>& entries) {
  Eigen::MatrixXd P(static_cast<Index>(entries.size()), static_cast<Index>(entries.size()));
  ekf.state().covariance(entries, entries, P);
  return P;
}

Motion some_motion(RandomDraws& draws) {
  return {{1.0, draws.uniform(-0.3, 0.3), draws.uniform(-0.5, 0.5)}, draws.covariance(3, 0.05), 1.0, 0.2};
}

TEST(BearingEkf, StartsAtTheOriginKnownExactly) {
  const BearingEkf ekf{BearingEkfSettings{}};
  EXPECT_EQ(ekf.state().pose(), Pose2{});
  EXPECT_TRUE(ekf.state().pose_covariance().isZero());
}

TEST(BearingEkf, PredictsAsTheMotionModel) {
  RandomDraws draws(111);
  BearingEkf ekf{BearingEkfSettings{}};
  const Motion first = some_motion(draws), second = some_motion(draws);
  ekf.predict(first);
  const Eigen::Matrix3d P = ekf.state().pose_covariance();
  EXPECT_LT((P - first.covariance).norm(), 1e-15);
  const MovedPose moved = apply(ekf.state().pose(), second);
  ekf.predict(second);
  EXPECT_EQ(ekf.state().pose(), moved.T_map_body);
  EXPECT_LT((ekf.state().pose_covariance() - (moved.G * P * moved.G.transpose() + moved.noise)).norm(), 1e-15);
}

TEST(BearingEkf, AddedPointHasThePropagatedCovariance) {
  RandomDraws draws(112);
  for (int trial = 0; trial < 50; ++trial) {
    BearingEkf ekf{with_yaw_state()};
    ekf.predict(some_motion(draws));
    const Index clone = ekf.clone_robot();
    ekf.predict(some_motion(draws));
    const double sigma_rad = 0.02, azimuth_i = draws.uniform(0.8, 1.2), azimuth_j = azimuth_i + draws.uniform(0.4, 0.9);
    const auto meeting =
        intersect(ekf.sighting_from(clone, azimuth_i), ekf.sighting_from(JointState::kPose, azimuth_j));
    ASSERT_TRUE(meeting);
    if (std::abs(meeting->sine) < 0.2) continue;

    const std::vector<Index> sources{clone, clone + 1, clone + 2, 0, 1, 2, kYaw};
    Eigen::VectorXd x(9);
    for (std::size_t i = 0; i < sources.size(); ++i) x(static_cast<Index>(i)) = ekf.state().mean(sources[i]);
    x.tail<2>() << azimuth_i, azimuth_j;
    const auto point = [](const Eigen::VectorXd& in) {
      return intersect({{in(0), in(1), in(2)}, in(7) + in(6)}, {{in(3), in(4), in(5)}, in(8) + in(6)})
          ->p_map_landmark_m;
    };
    const Eigen::MatrixXd J = numeric_jacobian(point, x, {}, 2e-4);
    const Eigen::MatrixXd P = covariance_of(ekf, sources);
    const Eigen::MatrixXd P_LX = J.leftCols<7>() * P;
    const Eigen::MatrixXd P_LL =
        P_LX * J.leftCols<7>().transpose() + sigma_rad * sigma_rad * J.rightCols<2>() * J.rightCols<2>().transpose();

    const Index landmark = ekf.add_point(*meeting, clone, JointState::kPose, sigma_rad);
    EXPECT_LT((ekf.state().position(landmark) - point(x)).norm(), 1e-12);
    EXPECT_LT(largest_difference(ekf.state().position_covariance(landmark), P_LL), kJacobianTolerance);
    std::vector<Index> all{landmark, landmark + 1};
    all.insert(all.end(), sources.begin(), sources.end());
    EXPECT_LT(largest_difference(covariance_of(ekf, all).topRightCorner(2, 7), P_LX), kJacobianTolerance);
  }
}

TEST(BearingEkf, AddedRayHasThePropagatedCovariance) {
  RandomDraws draws(113);
  BearingEkf ekf{with_yaw_state()};
  ekf.predict(some_motion(draws));
  const Index block = ekf.add_ray(3.0, 0.02, 0.25, 0.3);
  const InverseDepth ray = ekf.ray(block);
  EXPECT_EQ(ray.anchor, ekf.state().pose().position());
  EXPECT_NEAR(ray.bearing_rad, wrap(ekf.state().pose().heading_rad + 3.0 + 0.2), 1e-15);
  EXPECT_EQ(ray.inverse_distance_per_m, 0.25);

  const std::vector<Index> sources{0, 1, 2, kYaw};
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(4, 4);  // (anchor, bearing, inverse distance) by (pose, yaw)
  J.topLeftCorner<3, 3>().setIdentity();
  J(2, 3) = 1.0;
  Eigen::MatrixXd expected = J * covariance_of(ekf, sources) * J.transpose();
  expected.diagonal() += Eigen::Vector4d(0.0, 0.0, 0.02 * 0.02, 0.3 * 0.3);
  EXPECT_LT((covariance_of(ekf, {block, block + 1, block + 2, block + 3}) - expected).norm(), 1e-15);
}

TEST(BearingEkf, APromotedRayKeepsItsPredictedBearing) {
  RandomDraws draws(114);
  BearingEkf ekf{BearingEkfSettings{}};
  const Index block = ekf.add_ray(0.3, 0.01, 0.25, 0.02);
  ekf.predict(some_motion(draws));
  MappedSighting sighting{JointState::kPose, block, BlockKind::inverse_depth, 0.4, 1e-4};
  const auto as_ray = ekf.linearise(sighting);
  const double variance_of_ray = ekf.prediction_covariance(*as_ray, *as_ray);
  ekf.promote(block);
  sighting.kind = BlockKind::point;
  const auto as_point = ekf.linearise(sighting);
  EXPECT_NEAR(as_point->innovation, as_ray->innovation, 1e-12);
  EXPECT_NEAR(ekf.prediction_covariance(*as_point, *as_point), variance_of_ray, 1e-12);
}

TEST(BearingEkf, LinearityIndexFallsAsTheDistanceBecomesKnown) {
  BearingEkf ekf{BearingEkfSettings{}};
  const Index vague = ekf.add_ray(0.0, 0.01, 0.25, 0.25), known = ekf.add_ray(1.0, 0.01, 0.25, 0.0025);
  const Index beyond_infinity = ekf.add_ray(2.0, 0.01, -0.1, 0.25);
  // 4 sigma_d / d for a landmark straight ahead
  EXPECT_NEAR(ekf.linearity_index(vague), 4.0 * (0.25 * 16.0) / 4.0, 1e-12);
  EXPECT_NEAR(ekf.linearity_index(known), ekf.linearity_index(vague) / 100.0, 1e-12);
  EXPECT_EQ(ekf.linearity_index(beyond_infinity), std::numeric_limits<double>::infinity());
}

TEST(BearingEkf, PredictionCovarianceIsHPH) {
  RandomDraws draws(115);
  BearingEkf ekf{with_yaw_state()};
  ekf.predict(some_motion(draws));
  const Index ray = ekf.add_ray(0.5, 0.02, 0.3, 0.1), clone = ekf.clone_robot();
  ekf.predict(some_motion(draws));
  const auto a = ekf.linearise({JointState::kPose, ray, BlockKind::inverse_depth, 0.6, 1e-4});
  const auto b = ekf.linearise({clone, ray, BlockKind::inverse_depth, 0.5, 1e-4});
  const auto dense = [&](const ObservationRow& row) {
    Eigen::RowVectorXd h = Eigen::RowVectorXd::Zero(ekf.state().extent());
    for (int p = 0; p < row.count; ++p)
      for (Index i = 0; i < row.parts[static_cast<std::size_t>(p)].size; ++i)
        h(row.parts[static_cast<std::size_t>(p)].offset + i) +=
            row.parts[static_cast<std::size_t>(p)].coefficients[static_cast<std::size_t>(i)];
    return h;
  };
  std::vector<Index> all(static_cast<std::size_t>(ekf.state().extent()));
  std::iota(all.begin(), all.end(), 0);
  const Eigen::MatrixXd P = covariance_of(ekf, all);
  EXPECT_NEAR(ekf.prediction_covariance(*a, *b), (dense(*a) * P * dense(*b).transpose())(0, 0), 1e-14);
  const Matrix6d P6 = ekf.joint_pose_covariance(clone, JointState::kPose);
  EXPECT_LT((P6 - covariance_of(ekf, {clone, clone + 1, clone + 2, 0, 1, 2})).norm(), 1e-15);
}

TEST(BearingEkf, LearnsTheCamerasYawFromAKnownWorld) {
  BearingEkf ekf{with_yaw_state()};
  constexpr double kTrueYaw_rad = 0.25;
  const Index ray = ekf.add_ray(0.0 - 0.2, 1e-4, 0.25, 1e-4);  // the prior yaw is 0.2, so the ray points straight ahead
  const Index clone = ekf.clone_robot();
  ASSERT_EQ(clone > 0 && ray > 0, true);
  ekf.predict({{2.0, 0.0, 0.0}, Eigen::Vector3d(1e-8, 1e-8, 1e-8).asDiagonal(), 2.0, 0.0});
  // A wrong yaw turns the landmark's estimated direction by the same angle. Driving towards the landmark reveals it.
  const Eigen::Vector2d landmark = 4.0 * Eigen::Vector2d(std::cos(kTrueYaw_rad - 0.2), std::sin(kTrueYaw_rad - 0.2));
  const auto seen = predict_bearing(ekf.state().pose(), landmark, 0.0);
  const std::array sightings{
      MappedSighting{JointState::kPose, ray, BlockKind::inverse_depth, seen->azimuth_rad - kTrueYaw_rad, 1e-8}};
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(ekf.update(sightings));
  EXPECT_NEAR(ekf.yaw_offset_rad(), kTrueYaw_rad, 2e-3);
}

TEST(BearingEkf, LeavesOutLandmarksTooNearToUse) {
  BearingEkf ekf{BearingEkfSettings{}};
  const Index ray = ekf.add_ray(0.0, 0.01, 0.5, 0.1);
  ekf.predict({{1.99, 0.0, 0.0}, Eigen::Matrix3d::Identity() * 0.01, 2.0, 0.0});
  const std::array sightings{MappedSighting{JointState::kPose, ray, BlockKind::inverse_depth, 1.0, 1e-4}};
  const Pose2 before = ekf.state().pose();
  EXPECT_FALSE(ekf.linearise(sightings[0]));
  ekf.update(sightings);
  EXPECT_EQ(ekf.state().pose(), before);
}

}  // namespace
}  // namespace azimuth
