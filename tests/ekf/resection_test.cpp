#include "slam/ekf/resection.hpp"

#include <Eigen/Cholesky>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/ekf/bearing_model.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kSigmaDirection_rad = 0.01, kNearest_m = 0.05;

struct Room {
  Pose2 T_map_body;
  std::vector<DirectionTo> directions;
  Eigen::MatrixXd P;  // covariance of the landmarks
};

/// A robot among landmarks whose position errors are correlated and have a standard deviation of `sigma_landmark_m`.
Room room(int landmarks, double sigma_landmark_m, RandomDraws& draws) {
  Room room{{draws.uniform(-5.0, 5.0), draws.uniform(-5.0, 5.0), draws.uniform(-kPi, kPi)}, {}, {}};
  const Index n = 2 * landmarks;
  Eigen::MatrixXd A(n, n);
  for (Index i = 0; i < A.size(); ++i) A.data()[i] = draws.normal();
  room.P = sigma_landmark_m * sigma_landmark_m / static_cast<double>(n) * A * A.transpose();
  while (static_cast<int>(room.directions.size()) < landmarks) {
    const Eigen::Vector2d p(draws.uniform(-8.0, 8.0), draws.uniform(-8.0, 8.0));
    if ((p - room.T_map_body.position()).norm() < 1.0) continue;
    room.directions.push_back({p, predict_bearing(room.T_map_body, p, kNearest_m)->azimuth_rad});
  }
  return room;
}

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, wrap(a.heading_rad - b.heading_rad)};
}

TEST(Resection, FindsThePoseFromExactDirections) {
  RandomDraws draws(81);
  for (int round = 0; round < 300; ++round) {
    const Room here = room(draws.integer(5, 12), 0.01, draws);
    const auto found = resect(here.directions, here.P, kSigmaDirection_rad * kSigmaDirection_rad, kNearest_m);
    ASSERT_TRUE(found) << round;
    EXPECT_LT(difference(found->T_map_body, here.T_map_body).norm(), 1e-6) << round;
    EXPECT_LT(found->chi2, 1e-9);
    EXPECT_GT(found->rival_chi2, 30.0) << round;
  }
}

TEST(Resection, IsAsFarOffAsItSays) {
  RandomDraws draws(82);
  double nees = 0.0, chi2 = 0.0, freedom = 0.0;
  constexpr int kRounds = 500;
  for (int round = 0; round < kRounds; ++round) {
    Room here = room(8, 0.05, draws);
    const Eigen::MatrixXd L = Eigen::LLT<Eigen::MatrixXd>(here.P).matrixL();
    Eigen::VectorXd draw(L.rows());
    for (double& value : draw) value = draws.normal();
    const Eigen::VectorXd error = L * draw;
    for (std::size_t i = 0; i < here.directions.size(); ++i) {
      here.directions[i].p_map_landmark_m += error.segment<2>(2 * static_cast<Index>(i));
      here.directions[i].azimuth_rad = wrap(here.directions[i].azimuth_rad + kSigmaDirection_rad * draws.normal());
    }
    const auto found = resect(here.directions, here.P, kSigmaDirection_rad * kSigmaDirection_rad, kNearest_m);
    ASSERT_TRUE(found);
    const Eigen::Vector3d off = difference(found->T_map_body, here.T_map_body);
    nees += off.dot(found->covariance.ldlt().solve(off));
    chi2 += found->chi2;
    freedom += static_cast<double>(here.directions.size()) - 3.0;
  }
  std::printf("NEES %.2f (3 is ideal), chi2 / degrees of freedom %.2f\n", nees / kRounds, chi2 / freedom);
  EXPECT_NEAR(nees / kRounds, 3.0, 0.5);
  EXPECT_NEAR(chi2 / freedom, 1.0, 0.1);
}

TEST(Resection, DerivativesAgreeWithNumericDifferentiation) {
  RandomDraws draws(83);
  for (int round = 0; round < 20; ++round) {
    const Room here = room(6, 0.02, draws);
    const auto found = resect(here.directions, here.P, kSigmaDirection_rad * kSigmaDirection_rad, kNearest_m);
    ASSERT_TRUE(found);
    constexpr double kStep_m = 1e-4;
    for (Index i = 0; i < found->by_landmarks.cols(); ++i) {
      const auto moved = [&](double by_m) {
        std::vector<DirectionTo> directions = here.directions;
        directions[static_cast<std::size_t>(i / 2)].p_map_landmark_m(i % 2) += by_m;
        return resect(directions, here.P, kSigmaDirection_rad * kSigmaDirection_rad, kNearest_m)->T_map_body;
      };
      const Eigen::Vector3d numeric = difference(moved(kStep_m), moved(-kStep_m)) / (2.0 * kStep_m);
      EXPECT_LT((numeric - found->by_landmarks.col(i)).norm(), 1e-6 * (1.0 + numeric.norm())) << round;
    }
    const Eigen::Matrix3d sum = found->by_landmarks * here.P * found->by_landmarks.transpose() + found->noise;
    EXPECT_LT((sum - found->covariance).norm(), 1e-9 * found->covariance.norm());
  }
}

TEST(Resection, SeesThatNamesAreMixedUp) {
  RandomDraws draws(84);
  int believed = 0;
  for (int round = 0; round < 200; ++round) {
    Room here = room(7, 0.02, draws);
    std::swap(here.directions[0].azimuth_rad, here.directions[1].azimuth_rad);
    std::swap(here.directions[2].azimuth_rad, here.directions[3].azimuth_rad);
    const auto found = resect(here.directions, here.P, kSigmaDirection_rad * kSigmaDirection_rad, kNearest_m);
    if (found && found->chi2 < 13.3) ++believed;  // 99 % quantile of 4 degrees of freedom
  }
  EXPECT_LE(believed, 2);
}

TEST(Resection, NeedsThreeDirections) {
  RandomDraws draws(85);
  const Room two = room(2, 0.01, draws);
  EXPECT_FALSE(resect(two.directions, two.P, kSigmaDirection_rad * kSigmaDirection_rad, kNearest_m));
  EXPECT_FALSE(resect({}, Eigen::MatrixXd(0, 0), kSigmaDirection_rad * kSigmaDirection_rad, kNearest_m));
}

/// A map is made from two poses; then the robot is carried away.
TEST(Relocation, CorrelatesThePoseWithTheMapItWasFoundIn) {
  BearingEkf ekf({.retraction = JointState::Retraction::additive});
  const auto drive = [&](double distance_m) {
    Motion motion;
    motion.T_start_end = {distance_m, 0.0, 0.0};
    motion.covariance = Eigen::Vector3d(1e-3, 1e-3, 1e-4).asDiagonal();
    motion.path_m = distance_m;
    ekf.predict(motion);
  };
  const std::vector<Eigen::Vector2d> landmarks{{3, 4}, {-2, 5}, {1, -4}, {5, -3}, {-4, -2}, {6, 2}};
  const Index start = ekf.clone_robot();
  drive(2.0);
  std::vector<MappedSighting> sightings;
  const Pose2 T_map_body{1.0, 1.0, 2.0};  // the pose after the robot was carried away
  for (const Eigen::Vector2d& p : landmarks) {
    const auto seen = [&](Index pose) {
      return ekf.sighting_from(pose, predict_bearing(ekf.state().pose(pose), p, kNearest_m)->azimuth_rad);
    };
    const Index block =
        ekf.add_point(*intersect(seen(start), seen(JointState::kPose)), start, JointState::kPose, kSigmaDirection_rad);
    sightings.push_back({JointState::kPose, block, BlockKind::point,
                         predict_bearing(T_map_body, p, kNearest_m)->azimuth_rad,
                         kSigmaDirection_rad * kSigmaDirection_rad});
  }
  const auto found = ekf.resect(sightings);
  ASSERT_TRUE(found);
  ekf.relocate(sightings, *found);
  EXPECT_LT(difference(ekf.state().pose(), T_map_body).norm(), 1e-6);
  EXPECT_TRUE(ekf.state().pose_covariance().isApprox(found->covariance, 1e-9));
  // To first order the pose is J landmarks + noise, so its cross-covariance with any entry is J P_landmarks,entry.
  for (std::size_t k = 0; k < sightings.size(); ++k)
    for (const Index axis : {0, 1}) {
      const Index entry = sightings[k].landmark + axis;
      Eigen::Vector3d expected = Eigen::Vector3d::Zero();
      for (std::size_t j = 0; j < sightings.size(); ++j)
        for (const Index other : {0, 1})
          expected += found->by_landmarks.col(2 * static_cast<Index>(j) + other) *
                      ekf.state().covariance(sightings[j].landmark + other, entry);
      for (Index r = 0; r < 3; ++r)
        EXPECT_NEAR(ekf.state().covariance(JointState::kPose + r, entry), expected(r), 1e-12);
    }
}

}  // namespace
}  // namespace azimuth
