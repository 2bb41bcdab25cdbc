#include <gtest/gtest.h>
#include <limits>

#include "slam/geometry/pose2.hpp"
#include "slam/geometry/rigid_alignment.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

TEST(Wrap, StaysInItsHalfOpenRangeAndKeepsTheDirection) {
  RandomDraws draws(31);
  for (int i = 0; i < 2000; ++i) {
    const double angle_rad = draws.uniform(-1e3, 1e3), wrapped = wrap(angle_rad);
    EXPECT_GE(wrapped, -kPi);
    EXPECT_LT(wrapped, kPi);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle_rad), 1e-12);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle_rad), 1e-12);
  }
}

TEST(Wrap, EdgesOfTheRange) {
  EXPECT_EQ(wrap(kPi), -kPi);
  EXPECT_EQ(wrap(-kPi), -kPi);
  EXPECT_EQ(wrap(std::nextafter(kPi, 0.0)), std::nextafter(kPi, 0.0));
  for (int turns = -50; turns <= 50; ++turns) {
    const double wrapped = wrap((2 * turns + 1) * kPi);
    EXPECT_GE(wrapped, -kPi);
    EXPECT_LT(wrapped, kPi);
  }
}

TEST(Pose2, IsAGroup) {
  RandomDraws draws(32);
  for (int i = 0; i < 300; ++i) {
    const Pose2 A = draws.pose(20.0), B = draws.pose(20.0), C = draws.pose(20.0);
    const Pose2 left = (A * B) * C, right = A * (B * C);
    EXPECT_LT((left.position() - right.position()).norm(), 1e-11);
    EXPECT_NEAR(wrap(left.heading_rad - right.heading_rad), 0.0, 1e-12);
    const Pose2 nothing = A * inverse(A);
    EXPECT_LT(nothing.position().norm(), 1e-12);
    EXPECT_NEAR(nothing.heading_rad, 0.0, 1e-12);
    const Eigen::Vector2d p_c = draws.point(10.0);
    EXPECT_LT(((A * B) * p_c - A * (B * p_c)).norm(), 1e-11);
  }
}

TEST(Pose2, InterpolatesTheShorterWayRound) {
  const Pose2 start{0.0, 0.0, 3.0}, end{2.0, 4.0, -3.0};
  const Pose2 middle = interpolate(start, end, 0.5);
  EXPECT_NEAR(middle.x_m, 1.0, 1e-12);
  EXPECT_NEAR(middle.y_m, 2.0, 1e-12);
  EXPECT_NEAR(std::abs(wrap(middle.heading_rad - kPi)), 0.0, 1e-12);
  EXPECT_EQ(interpolate(start, end, 0.0), start);
}

TEST(RigidAlignment, RecoversAMotionAndIsTheMinimum) {
  RandomDraws draws(33);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose2 T_to_from = draws.pose(30.0);
    std::vector<Eigen::Vector2d> from, to;
    for (int i = 0; i < 10; ++i) {
      from.push_back(draws.point(10.0));
      to.push_back(T_to_from * from.back());
    }
    const Pose2 exact = align(from, to);
    EXPECT_LT((exact.position() - T_to_from.position()).norm(), 1e-9);
    EXPECT_NEAR(wrap(exact.heading_rad - T_to_from.heading_rad), 0.0, 1e-12);

    for (auto& p : to) p += Eigen::Vector2d(draws.normal(0.3), draws.normal(0.3));
    const auto cost = [&](const Pose2& T) {
      double sum = 0.0;
      for (std::size_t i = 0; i < from.size(); ++i) sum += (T * from[i] - to[i]).squaredNorm();
      return sum;
    };
    const Pose2 best = align(from, to);
    for (int i = 0; i < 20; ++i) {
      const Pose2 other{best.x_m + draws.normal(0.01), best.y_m + draws.normal(0.01),
                        best.heading_rad + draws.normal(0.001)};
      EXPECT_LE(cost(best), cost(other));
    }
  }
}

TEST(RigidAlignment, WithFewPointsOnlyTranslates) {
  const std::vector<Eigen::Vector2d> from{{1.0, 2.0}}, to{{4.0, 6.0}};
  EXPECT_EQ(align(from, to), (Pose2{3.0, 4.0, 0.0}));
  EXPECT_EQ(align({}, {}), Pose2{});
}

}  // namespace
}  // namespace azimuth
