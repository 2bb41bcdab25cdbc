#include "slam/ekf/triangulation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/ekf/bearing_model.hpp"
#include "slam/geometry/motion.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

// ---- Rejection before sampling ----

/// The bearings of `landmark` from both poses.
std::pair<Sighting, Sighting> sightings_of(const Eigen::Vector2d& landmark, const Pose2& i, const Pose2& j) {
  return {{i, predict_bearing(i, landmark, 0.0)->azimuth_rad}, {j, predict_bearing(j, landmark, 0.0)->azimuth_rad}};
}

TEST(Intersection, ParallelRaysDoNotMeet) {
  EXPECT_FALSE(intersect({{0.0, 0.0, 0.0}, 0.0}, {{0.0, 1.0, 0.0}, 0.0}));
  const QualityTest test(10);
  EXPECT_EQ(test.relative_entropy({{0.0, 0.0, 0.0}, 0.0}, {{0.0, 1.0, 0.0}, 0.0}, Matrix6d::Zero(), 0.02),
            std::numeric_limits<double>::infinity());
}

TEST(Intersection, NearlyParallelRaysAreNotValid) {
  for (const double parallax_rad : {0.5e-3, 2e-3}) {
    const auto meeting = intersect({{0.0, 0.0, 0.0}, kPi / 2.0}, {{1.0, 0.0, 0.0}, kPi / 2.0 + parallax_rad});
    ASSERT_TRUE(meeting);
    EXPECT_EQ(meeting->valid(), parallax_rad > 1e-3);
  }
}

TEST(Intersection, BehindEitherRobotIsNotValid) {
  const Eigen::Vector2d landmark(2.0, 3.0);
  const auto [i, j] = sightings_of(landmark, {0.0, 0.0, 0.4}, {1.0, 0.0, -0.3});
  ASSERT_TRUE(intersect(i, j)->valid());
  for (const auto& [turn_i, turn_j] : {std::pair(kPi, 0.0), std::pair(0.0, kPi), std::pair(kPi, kPi)}) {
    const Sighting behind_i{i.T_map_body, i.azimuth_rad + turn_i}, behind_j{j.T_map_body, j.azimuth_rad + turn_j};
    const auto meeting = intersect(behind_i, behind_j);
    ASSERT_TRUE(meeting);
    EXPECT_LT((meeting->p_map_landmark_m - landmark).norm(), 1e-9) << "the lines are the same";
    EXPECT_FALSE(meeting->valid());
    EXPECT_EQ(meeting->distance_i_m<0.0, turn_i> 0.0);
    EXPECT_EQ(meeting->distance_j_m<0.0, turn_j> 0.0);
    EXPECT_TRUE(std::isinf(QualityTest(10).relative_entropy(behind_i, behind_j, Matrix6d::Zero(), 0.02)));
  }
}

// ---- Factor of a singular covariance ----

void expect_factor(const Matrix6d& P6) {
  const Matrix6d L = semidefinite_cholesky(P6);
  EXPECT_TRUE(L.isLowerTriangular());
  EXPECT_LT((L * L.transpose() - P6).cwiseAbs().maxCoeff(), 1e-9 * std::max(1.0, P6.diagonal().maxCoeff()));
}

TEST(SemidefiniteCholesky, OfRegularMatrices) {
  RandomDraws draws(81);
  for (int i = 0; i < 100; ++i) expect_factor(draws.covariance(6, draws.uniform(0.01, 3.0)));
}

TEST(SemidefiniteCholesky, OfZero) { EXPECT_TRUE(semidefinite_cholesky(Matrix6d::Zero()).isZero()); }

TEST(SemidefiniteCholesky, OfAFreshClone) {
  RandomDraws draws(82);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d P = draws.covariance(3, 0.1);
    Matrix6d P6;
    P6 << P, P, P, P;
    expect_factor(P6);
    EXPECT_LT(semidefinite_cholesky(P6).rightCols<3>().cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(SemidefiniteCholesky, OfAnExactFirstPose) {
  RandomDraws draws(83);
  Matrix6d P6 = Matrix6d::Zero();
  P6.bottomRightCorner<3, 3>() = draws.covariance(3, 0.1);
  expect_factor(P6);
  EXPECT_TRUE(semidefinite_cholesky(P6).leftCols<3>().isZero());
}

TEST(SemidefiniteCholesky, OfAnyRank) {
  RandomDraws draws(84);
  for (int rank = 1; rank < 6; ++rank)
    for (int i = 0; i < 50; ++i) {
      Eigen::MatrixXd A(6, rank);
      for (int c = 0; c < rank; ++c) A.col(c) = draws.normals(6);
      expect_factor(A * A.transpose());
    }
}

// ---- The quality test ----

TEST(LandmarkCovariance, IsThatOfSampledIntersections) {
  RandomDraws draws(85);
  const auto [i, j] = sightings_of({2.0, 2.0}, {0.0, 0.0, 0.4}, {1.0, -0.2, 0.7});
  const Matrix6d P6 = draws.covariance(6, 1e-4);  // small, so that the first-order covariance is accurate
  constexpr double kSigma_rad = 1e-4;
  const auto mean = intersect(i, j);
  const Matrix6d L = semidefinite_cholesky(P6);
  Eigen::Matrix2d sampled = Eigen::Matrix2d::Zero();
  constexpr int kSamples = 20000;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Eigen::Matrix<double, 6, 1> e = L * draws.normals(6);
    const Pose2 &a = i.T_map_body, &b = j.T_map_body;
    const auto meeting =
        intersect({{a.x_m + e(0), a.y_m + e(1), a.heading_rad + e(2)}, i.azimuth_rad + draws.normal(kSigma_rad)},
                  {{b.x_m + e(3), b.y_m + e(4), b.heading_rad + e(5)}, j.azimuth_rad + draws.normal(kSigma_rad)});
    const Eigen::Vector2d error = meeting->p_map_landmark_m - mean->p_map_landmark_m;
    sampled += error * error.transpose() / kSamples;
  }
  const Eigen::Matrix2d predicted = landmark_covariance(*mean, P6, kSigma_rad);
  EXPECT_LT((sampled - predicted).norm() / predicted.norm(), 0.05);
}

TEST(QualityTest, DoesNotDependOnTheFrameOrOnTheRobotsHeadings) {
  // Exact only with certain poses: the samples of uncertain poses are fixed, so a rotation turns them relative to the
  // geometry.
  RandomDraws draws(86);
  const QualityTest test(1000);
  const Eigen::Vector2d landmark(2.0, 3.0);
  const auto [i, j] = sightings_of(landmark, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.1});
  const double expected = test.relative_entropy(i, j, Matrix6d::Zero(), 0.0262);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose2 T = draws.pose(10.0);
    const Pose2 turn_i{0.0, 0.0, draws.uniform(-kPi, kPi)}, turn_j{0.0, 0.0, draws.uniform(-kPi, kPi)};
    const auto [moved_i, moved_j] = sightings_of(T * landmark, T * i.T_map_body * turn_i, T * j.T_map_body * turn_j);
    EXPECT_NEAR(test.relative_entropy(moved_i, moved_j, Matrix6d::Zero(), 0.0262), expected, 1e-9);
  }
}

TEST(QualityTest, TermsAverageToTheRelativeEntropy) {
  const auto [i, j] = sightings_of({2.0, 3.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.1});
  const QualityTest test(50);
  const auto terms = test.terms(i, j, Matrix6d::Identity() * 1e-4, 0.02, 100);
  ASSERT_EQ(terms.size(), 50u);
  double sum = 0.0;
  for (const double term : terms) sum += term;
  EXPECT_NEAR(sum / 50.0, test.relative_entropy(i, j, Matrix6d::Identity() * 1e-4, 0.02), 1e-12);
}

// ---- The curve of mathematics I.9: median over draws, against parallax, 1 m baseline ----

/// The covariance of both poses when the first is certain and the second follows after 1 m with small turns, under the
/// paper's odometry noise (mathematics I.3, set 1 and set 2).
Matrix6d covariance_after_a_metre(double sigma_m, double sigma_deg) {
  constexpr double kTurn_rad = 0.1;
  MotionNoise noise;
  noise.lambda_distance_m = sigma_m * sigma_m;
  noise.lambda_rotation_rad = std::pow(degrees_to_rad(sigma_deg), 2) / (2.0 * kPi);
  Matrix6d P6 = Matrix6d::Zero();
  P6.bottomRightCorner<3, 3>() = motion_noise(0.0, {1.0, kTurn_rad, -kTurn_rad}, noise);
  return P6;
}

double median_relative_entropy(const QualityTest& test, double sigma_deg, double parallax_deg, const Matrix6d& P6) {
  constexpr std::size_t kDraws = 201;
  constexpr double kLeastOffBaseline_rad = 0.35;
  RandomDraws draws(87);
  std::vector<double> values;
  while (values.size() < kDraws) {
    const double parallax_rad = degrees_to_rad(parallax_deg);
    const double angle_i_rad = draws.uniform(kLeastOffBaseline_rad, kPi - kLeastOffBaseline_rad);
    const double angle_j_rad = angle_i_rad + parallax_rad;
    if (angle_j_rad > kPi - kLeastOffBaseline_rad) continue;
    const double distance_m = std::sin(angle_j_rad) / std::sin(parallax_rad);  // law of sines
    const Eigen::Vector2d landmark(distance_m * std::cos(angle_i_rad), distance_m * std::sin(angle_i_rad));
    const auto [i, j] = sightings_of(landmark, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
    values.push_back(test.relative_entropy(i, j, P6, degrees_to_rad(sigma_deg)));
  }
  std::ranges::nth_element(values, values.begin() + kDraws / 2);
  return values[kDraws / 2];
}

struct CurvePoint {
  double parallax_deg, relative_entropy;
};

/// The reference's draws of poses and landmarks are not known, so the curve is compared within a factor. Near parallel
/// the estimate has no finite expectation, so only its magnitude is compared.
void expect_curve(double sigma_deg, const Matrix6d& P6, std::initializer_list<CurvePoint> curve) {
  const QualityTest test(1000);
  for (const CurvePoint& point : curve) {
    const double median = median_relative_entropy(test, sigma_deg, point.parallax_deg, P6);
    const double factor = point.relative_entropy > 10.0 ? 1e6 : point.relative_entropy > 1.0 ? 2.5 : 1.4;
    EXPECT_GT(median, point.relative_entropy / std::min(factor, 2.5)) << sigma_deg << " at " << point.parallax_deg;
    EXPECT_LT(median, point.relative_entropy * factor) << sigma_deg << " at " << point.parallax_deg;
  }
}

TEST(QualityTest, FallsWithParallaxAsSpecified) {
  expect_curve(1.5, covariance_after_a_metre(0.05, 5.0),
               {{6, 31}, {8, 2.1}, {10, 0.52}, {12, 0.26}, {15, 0.14}, {20, 0.074}, {30, 0.031}});
  expect_curve(0.5, covariance_after_a_metre(0.03, 4.0),
               {{3, 17}, {4, 1.1}, {5, 0.42}, {6, 0.26}, {8, 0.12}, {10, 0.074}, {20, 0.019}});
}

}  // namespace
}  // namespace azimuth
