// The mathematics of merging two maps: derivatives, and agreement with the solution in information form.

#include "slam/map_merge/joint_fit.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "tests/map_merge/map_pair.hpp"

namespace azimuth::test {
namespace {

class GapDerivatives : public testing::TestWithParam<int> {};

TEST_P(GapDerivatives, AreThoseOfTheModel) {
  RandomDraws draws(static_cast<unsigned>(GetParam()));
  const double scale = GetParam() == 0 ? 0.0 : GetParam() == 1 ? 1e-8 : 10.0;  // identity, tiny, arbitrary
  const Pose2 T{scale * draws.normal(), scale * draws.normal(), wrap(scale * draws.normal())};
  const Eigen::Vector2d p_a = draws.point(20.0), p_b = draws.point(20.0);
  const Gap at = gap(p_a, T, p_b);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d off = kStep * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d numeric = (gap(p_a, T, p_b + off).value_m - gap(p_a, T, p_b - off).value_m) / (2.0 * kStep);
    EXPECT_LT((numeric - at.by_p_b.col(i)).norm(), 1e-6);
  }
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d off = kStep * Eigen::Vector3d::Unit(i);
    const auto moved = [&](double sign) {
      return gap(p_a, {T.x_m + sign * off.x(), T.y_m + sign * off.y(), T.heading_rad + sign * off.z()}, p_b).value_m;
    };
    EXPECT_LT(((moved(1.0) - moved(-1.0)) / (2.0 * kStep) - at.by_T.col(i)).norm(), 1e-6);
  }
}
INSTANTIATE_TEST_SUITE_P(Draws, GapDerivatives, testing::Range(0, 12));

/// The sum of squares of both maps over all landmarks and T, computed with the information matrices.
TEST(JointFit, IsTheLeastOfTheSumOfSquares) {
  RandomDraws draws(5);
  const std::vector<TrueLandmark3> hall = drawn_hall(draws);
  const Pose2 T_world_a{1.0, 2.0, 0.3}, T_world_b{30.0, -4.0, -2.0};
  const auto in_a = between(hall, 0.0, 20.0), in_b = between(hall, 8.0, 30.0);
  const DrawnMap map_a = drawn_map(in_a, T_world_a, draws), map_b = drawn_map(in_b, T_world_b, draws);
  const MapGaussian a = gaussian_of(map_a.map, Kept::landmarks), b = gaussian_of(map_b.map, Kept::landmarks);
  std::vector<Correspondence> pairs;
  for (std::size_t i = 0; i < in_a.size(); ++i)
    for (std::size_t k = 0; k < in_b.size(); ++k)
      if (in_a[i].p_world_m == in_b[k].p_world_m) pairs.push_back({i, k});
  ASSERT_GT(pairs.size(), 5U);
  const JointFit fit = fit_jointly(a, b, pairs, inverse(T_world_a) * T_world_b);
  ASSERT_TRUE(fit.sound);

  // The unknowns are a's landmarks, b's landmarks in a's frame (common ones are a's) and T. The fit must minimise the
  // cost.
  const Eigen::MatrixXd information_a = a.covariance.inverse(), information_b = b.covariance.inverse();
  const auto cost = [&](const Eigen::VectorXd& moved_a, const Eigen::VectorXd& moved_b, const Pose2& T) {
    Eigen::VectorXd of_b = moved_b;
    for (const Correspondence& pair : pairs) {
      of_b.segment<2>(b.row[pair.b]) = inverse(T) * Eigen::Vector2d(moved_a.segment<2>(a.row[pair.a]));
      of_b(b.row[pair.b] + 2) = moved_a(a.row[pair.a] + 2);
    }
    const Eigen::VectorXd off_a = moved_a - a.mean, off_b = of_b - b.mean;
    return off_a.dot(information_a * off_a) + off_b.dot(information_b * off_b);
  };
  const double least = cost(fit.mean_a, fit.mean_b, fit.T_a_b);
  EXPECT_NEAR(least, fit.chi2, 1e-6 * (1.0 + fit.chi2));
  for (int n = 0; n < 40; ++n) {
    const Eigen::VectorXd off_a = 1e-3 * draws.normals(a.mean.size()), off_b = 1e-3 * draws.normals(b.mean.size());
    const Pose2 T{fit.T_a_b.x_m + draws.normal(1e-3), fit.T_a_b.y_m + draws.normal(1e-3),
                  fit.T_a_b.heading_rad + draws.normal(1e-4)};
    EXPECT_GT(cost(fit.mean_a + off_a, fit.mean_b + off_b, T), least);
  }
}

TEST(JointFit, SaysWhenThePairsFixNothing) {
  RandomDraws draws(6);
  const std::vector<TrueLandmark3> hall = drawn_hall(draws);
  const DrawnMap map = drawn_map(between(hall, 0.0, 20.0), {}, draws);
  const MapGaussian a = gaussian_of(map.map, Kept::everything), b = gaussian_of(map.map, Kept::landmarks);
  EXPECT_FALSE(fit_jointly(a, b, std::vector<Correspondence>{}, {}).sound);
  EXPECT_FALSE(fit_jointly(a, b, std::vector<Correspondence>{{0, 0}}, {}).sound);
}

}  // namespace
}  // namespace azimuth::test
