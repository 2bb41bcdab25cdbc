// Compares covariances with the inverse of the whole dense matrix.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/smoother/smoother.hpp"
#include "tests/support/batch_solution.hpp"
#include "tests/support/named_drive.hpp"

namespace azimuth {
namespace {

struct Solved {
  NamedDrive drive;
  Smoother smoother;
  DriveFeeder feeder;
  Eigen::MatrixXd inverse;  // unknowns in the order of BatchProblem, pose errors along the pose's own axes

  explicit Solved(const SmootherSettings& settings)
      : drive(named_drive({.seed = 3, .images = 90})), smoother(settings), feeder(drive) {
    while (!feeder.done()) {
      feeder.feed(smoother);
      smoother.optimise(4);
    }
    smoother.optimise(100);
    const BatchProblem batch(smoother.graph(), settings);
    const Eigen::MatrixXd lower(batch.normal().H);
    inverse = lower.selfadjointView<Eigen::Lower>().llt().solve(Eigen::MatrixXd::Identity(batch.rows(), batch.rows()));
  }
};

/// Everything is linearised at the optimum, so that the factor's matrix equals the batch matrix.
SmootherSettings always_linearised() {
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  settings.relinearise_beyond = 1e-9;
  settings.reweigh_beyond = 1e-9;
  return settings;
}

TEST(SmootherCovariance, OfPosesAndLandmarksIsTheInversesBlock) {
  const SmootherSettings settings = always_linearised();
  Solved solved(settings);
  const BatchProblem batch(solved.smoother.graph(), settings);
  const PoseId newest = solved.smoother.graph().poses() - 1;
  const LandmarkId a = solved.feeder.landmark(0), b = solved.feeder.landmark(5);
  const std::vector<Smoother::Unknown> unknowns{Smoother::PoseOf{newest}, Smoother::LandmarkOf{a}, Smoother::PoseOf{20},
                                                Smoother::LandmarkOf{b}};
  const Eigen::MatrixXd P = solved.smoother.covariance(unknowns);

  std::vector<Eigen::Index> rows;
  for (const auto& [first, count] : {std::pair{batch.row_of_pose(newest), 3},
                                     {batch.row_of_landmark(a), 2},
                                     {batch.row_of_pose(20), 3},
                                     {batch.row_of_landmark(b), 2}})
    for (Eigen::Index i = 0; i < count; ++i) rows.push_back(first + i);
  Eigen::MatrixXd to_map = Eigen::MatrixXd::Identity(10, 10);
  to_map.block<2, 2>(0, 0) = rotation(solved.smoother.graph().pose(newest).heading_rad);
  to_map.block<2, 2>(5, 5) = rotation(solved.smoother.graph().pose(20).heading_rad);
  Eigen::MatrixXd expected(10, 10);
  for (Eigen::Index i = 0; i < 10; ++i)
    for (Eigen::Index k = 0; k < 10; ++k)
      expected(i, k) = solved.inverse(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(k)]);
  expected = to_map * expected * to_map.transpose();
  ASSERT_EQ(P.rows(), 10);
  EXPECT_LT((P - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff());
  EXPECT_LT((solved.smoother.newest_covariance() - expected.topLeftCorner<3, 3>()).norm(), 1e-8);
}

TEST(SmootherCovariance, WithLiveThresholdsIsWithinAFewPerCent) {
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  Solved solved(settings);
  const BatchProblem batch(solved.smoother.graph(), settings);
  const Eigen::Matrix3d P = solved.smoother.newest_covariance();
  const Eigen::Index row = batch.row_of_pose(solved.smoother.graph().poses() - 1);
  const Eigen::Matrix3d in_body = solved.inverse.block<3, 3>(row, row);
  EXPECT_NEAR(P.determinant() / in_body.determinant(), 1.0, 0.05);
}

TEST(SmootherCovariance, OfAPointIsThatOfItsChartCarriedOver) {
  Solved solved(always_linearised());
  const LandmarkId landmark = solved.feeder.landmark(0);
  ASSERT_TRUE(solved.smoother.graph().landmark(landmark).is_point());
  const Eigen::Matrix2d P = solved.smoother.point_covariance(landmark);
  EXPECT_GT(P.determinant(), 0.0);
  const Eigen::Vector2d off = solved.smoother.graph().landmark(landmark).p_map() - solved.drive.p_first_landmark[0];
  EXPECT_LT(off.dot(P.ldlt().solve(off)), 16.0);
}

TEST(SmootherCovariance, OfTheFirstPoseThereIsNone) {
  Solved solved(SmootherSettings{});
  EXPECT_EQ(solved.smoother.pose_covariance(0), Eigen::Matrix3d::Zero());
}

}  // namespace
}  // namespace azimuth
