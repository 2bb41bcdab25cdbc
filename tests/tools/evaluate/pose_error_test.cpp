#include "tools/evaluate/pose_error.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sim/world/random.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

std::vector<PosePair> pairs_of(const std::vector<Pose2>& estimated, const std::vector<Pose2>& truth) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < truth.size(); ++i) pairs.push_back({i, estimated[i], truth[i]});
  return pairs;
}

TEST(PoseErrors, GoldenAlignment) {
  const auto pairs = pairs_of({{0.0, 0.0, 0}, {4.0, 0.1, 0}, {4.1, 3.0, 0}, {0.2, 2.8, 0}},
                              {{1.0, 1.0, 0}, {4.4, 3.1, 0}, {2.9, 5.6, 0}, {-0.6, 3.5, 0}});
  const PoseErrors errors = pose_errors(pairs, alignment(pairs).value());
  const std::vector<double> expected{0.09633648227379794, 0.11768397158209537, 0.059280310643764766,
                                     0.2375337877081853};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(errors.position_m[i], expected[i], 1e-9);
}

TEST(PoseErrors, VanishUnderAnyRigidMotion) {
  const std::vector<Pose2> truth{{1.0, 2.0, 0.3}, {3.0, 2.5, 3.1}, {2.0, 7.0, -3.1}, {-4.0, 1.0, 1.0}};
  const Pose2 T_map_world{-3.0, 8.0, 2.9};
  std::vector<Pose2> estimated;
  for (const Pose2& pose : truth) estimated.push_back(T_map_world * pose);
  const auto pairs = pairs_of(estimated, truth);
  const PoseErrors errors = pose_errors(pairs, alignment(pairs).value());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(errors.position_m[i], 0.0, 1e-12);
    EXPECT_NEAR(errors.heading_rad[i], 0.0, 1e-12);
  }
}

TEST(PoseErrors, HeadingErrorsWrap) {
  const auto pairs = pairs_of({{0.0, 0.0, 3.1}}, {{0.0, 0.0, -3.1}});
  EXPECT_NEAR(pose_errors(pairs, Pose2{}).heading_rad[0], 2 * kPi - 6.2, 1e-12);
}

TEST(PoseErrors, OfTruthWithoutHeadingAreOfPositions) {
  const Pose2 nowhere{2.0, 1.0, std::nan("")};
  const PosePair pair{0, {2.0, 1.5, 0.3}, nowhere};
  const PoseErrors errors = pose_errors(std::vector{pair}, Pose2{});
  ASSERT_EQ(errors.position_m.size(), 1U);
  EXPECT_NEAR(errors.position_m[0], 0.5, 1e-12);
  EXPECT_TRUE(errors.heading_rad.empty());
  EXPECT_TRUE(relative_errors(std::vector{pair, pair}, {}).empty());
}

TEST(PoseErrors, NeedTruth) { EXPECT_FALSE(alignment({})); }

TEST(PairWithTruth, LeavesOutWhatHasNone) {
  const std::vector<StampedPose> estimated{{at_s(0.5), {}}, {at_s(1.5), {}}, {at_s(9.0), {}}};
  const std::vector<StampedPose> truth{{at_s(0.0), {}}, {at_s(1.0), {}}, {at_s(2.0), {4.0, 0.0, 0.0}}};
  const auto pairs = pair_with_truth(estimated, truth);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].index, 1u);
  EXPECT_DOUBLE_EQ(pairs[1].T_world_body.x_m, 2.0);
}

TEST(Consistency, IsThreeForHonestCovariances) {
  Random random(1, RandomPurpose::drive);
  Eigen::Matrix3d covariance;
  covariance << 0.04, 0.01, 0.002, 0.01, 0.09, -0.01, 0.002, -0.01, 0.01;
  const Eigen::Matrix3d factor = covariance.llt().matrixL();
  // The frame of the first pose is rotated against the world and the map, so the covariance must be rotated too.
  const Pose2 T_world_map{5.0, -2.0, 0.8};
  std::vector<EstimateRecord> estimates;
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < 20000; ++i) {
    const Pose2 T_map_body{random.uniform(-9, 9), random.uniform(-9, 9), i == 0 ? 1.3 : random.uniform(-3, 3)};
    Eigen::Vector3d noise{random.normal(1.0), random.normal(1.0), random.normal(1.0)};
    noise = i == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(factor * noise);
    const Pose2 estimated{T_map_body.x_m + noise.x(), T_map_body.y_m + noise.y(),
                          wrap(T_map_body.heading_rad + noise.z())};
    estimates.push_back({at_s(static_cast<double>(i)), estimated, covariance, {}});
    pairs.push_back({i, estimated, T_world_map * T_map_body});
  }
  const Consistency result = consistency(pairs, estimates);
  EXPECT_EQ(result.evaluated, 19999u);
  EXPECT_NEAR(result.anees, 3.0, 0.1);
}

TEST(Consistency, LeavesOutSingularCovariances) {
  Eigen::Matrix3d rank_two = Eigen::Matrix3d::Identity();
  rank_two(0, 1) = rank_two(1, 0) = 1.0;
  std::vector<EstimateRecord> estimates(4);
  estimates[1].covariance = rank_two;
  estimates[2].covariance = Eigen::Matrix3d::Constant(kNotMeasured);
  estimates[3].covariance = Eigen::Vector3d(4.0, 1.0, 1.0).asDiagonal();
  estimates[3].T_map_body = {2.0, 0.0, 0.0};
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < 4; ++i) pairs.push_back({i, estimates[i].T_map_body, {}});
  const Consistency result = consistency(pairs, estimates);
  EXPECT_EQ(result.singular, 2u);
  EXPECT_EQ(result.evaluated, 1u);
  EXPECT_DOUBLE_EQ(result.anees, 1.0);
}

TEST(TwoSigma, AreOfTheErrorsOwnDirection) {
  RelativeError error;
  error.covariance = Eigen::Vector3d(0.04, 0.01, 1.0).asDiagonal();
  error.error = {0.4, 0.0, 5.0};  // the heading is not used
  const TwoSigmaShare along = two_sigma_share(error).value();
  EXPECT_DOUBLE_EQ(along.of_direction, 1.0);
  EXPECT_NEAR(along.of_ellipse, 2.0 / std::sqrt(5.991), 1e-4);
  error.error = {0.0, 0.4, 0.0};
  EXPECT_DOUBLE_EQ(two_sigma_share(error).value().of_direction, 2.0);
  error.error.setZero();
  EXPECT_EQ(two_sigma_share(error).value().of_direction, 0.0);
  error.covariance(0, 0) = 0.0;
  EXPECT_FALSE(two_sigma_share(error));
}

TEST(TwoSigma, HoldWhatTheirChanceSays) {
  Random random(1, RandomPurpose::drive);
  constexpr int kErrors = 20000;
  int within_ellipse = 0, within_direction = 0;
  for (int i = 0; i < kErrors; ++i) {
    RelativeError error;
    error.covariance = Eigen::Vector3d(0.09, 0.09, 1.0).asDiagonal();
    error.error = {random.normal(0.3), random.normal(0.3), 0.0};
    const TwoSigmaShare share = two_sigma_share(error).value();
    within_ellipse += share.of_ellipse <= 1.0 ? 1 : 0;
    within_direction += share.of_direction <= 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(within_ellipse, 0.95 * kErrors, 0.01 * kErrors);
  EXPECT_NEAR(within_direction, 0.865 * kErrors, 0.01 * kErrors);
}

TEST(Consistency, OfNothingIsNotMeasured) { EXPECT_TRUE(std::isnan(consistency({}, {}).anees)); }

}  // namespace
}  // namespace azimuth
