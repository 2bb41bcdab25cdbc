#include "slam/association/view_interval.hpp"

#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kReach_m = 15.0;
constexpr double kRounding_rad = 1e-9;

double direction_from(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

Eigen::Vector2d random_point(RandomDraws& draws, double reach_m) {
  return {draws.uniform(-reach_m, reach_m), draws.uniform(-reach_m, reach_m)};
}

TEST(ViewInterval, HoldsEveryLandmarkInReachOfBothPlaces) {
  RandomDraws draws(71);
  int seen = 0;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Vector2d before = random_point(draws, 20.0), now = random_point(draws, 20.0);
    const Eigen::Vector2d landmark = random_point(draws, 20.0);
    if ((landmark - before).norm() > kReach_m || (landmark - now).norm() > kReach_m) continue;
    const auto interval = view_interval(before, direction_from(before, landmark), now, kReach_m);
    ASSERT_TRUE(interval) << "landmark " << landmark.transpose();
    ASSERT_TRUE(interval->contains(direction_from(now, landmark), kRounding_rad)) << landmark.transpose();
    ++seen;
  }
  EXPECT_GT(seen, 2000);
}

/// Whether some point on the ray is within reach of both places and is seen from `now` in the given direction, found by
/// sampling the ray.
bool possible_by_sampling(const Eigen::Vector2d& before, double ray_rad, const Eigen::Vector2d& now,
                          double direction_rad, double tolerance_rad) {
  constexpr int kSteps = 20000;
  for (int k = 1; k <= kSteps; ++k) {
    const double s = kReach_m * k / kSteps;
    const Eigen::Vector2d point = before + s * Eigen::Vector2d(std::cos(ray_rad), std::sin(ray_rad));
    if ((point - now).norm() <= kReach_m && std::abs(wrap(direction_from(now, point) - direction_rad)) < tolerance_rad)
      return true;
  }
  return false;
}

TEST(ViewInterval, HoldsNothingElse) {
  RandomDraws draws(72);
  int refused = 0;
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector2d before = random_point(draws, 12.0), now = random_point(draws, 12.0);
    const double ray_rad = draws.uniform(-kPi, kPi), direction_rad = draws.uniform(-kPi, kPi);
    const auto interval = view_interval(before, ray_rad, now, kReach_m);
    const bool held = interval && interval->contains(direction_rad, 0.0);
    if (held) {
      EXPECT_TRUE(possible_by_sampling(before, ray_rad, now, direction_rad, 0.02)) << k;
    } else {
      EXPECT_FALSE(possible_by_sampling(before, ray_rad, now, direction_rad, 1e-4)) << k;
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(ViewInterval, WithoutMovingTheDirectionStays) {
  const auto interval = view_interval({1.0, 2.0}, 2.5, {1.0, 2.0}, kReach_m);
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->sweep_rad, 0.0);
  EXPECT_TRUE(interval->contains(2.5, kRounding_rad));
  EXPECT_FALSE(interval->contains(2.6, 0.05));
}

TEST(ViewInterval, DrivingPastALandmarkAheadAllowsBothEnds) {
  // The robot drives straight along the ray, so the landmark is in front or behind. Noise decides the side on which the
  // interval sweeps its half turn.
  for (const double aside_m : {-1e-12, 0.0, 1e-12}) {
    const auto interval = view_interval({0.0, 0.0}, 0.0, {2.0, aside_m}, kReach_m);
    ASSERT_TRUE(interval);
    EXPECT_NEAR(std::abs(interval->sweep_rad), kPi, 1e-9);
    for (const double direction_rad : {0.0, 0.01, -0.01, kPi - 0.01, -kPi + 0.01})
      EXPECT_TRUE(interval->contains(direction_rad, 0.02)) << direction_rad << ", aside " << aside_m;
  }
}

TEST(ViewInterval, WidensAtBothEnds) {
  const ViewInterval turns_left{3.0, 1.0}, turns_right{3.0, -1.0};
  for (const double margin_rad : {0.0, 0.1}) {
    EXPECT_TRUE(turns_left.contains(wrap(3.0 - margin_rad + 1e-6), margin_rad));
    EXPECT_TRUE(turns_left.contains(wrap(4.0 + margin_rad - 1e-6), margin_rad));
    EXPECT_FALSE(turns_left.contains(wrap(3.0 - margin_rad - 1e-6), margin_rad));
    EXPECT_FALSE(turns_left.contains(wrap(4.0 + margin_rad + 1e-6), margin_rad));
    EXPECT_TRUE(turns_right.contains(wrap(2.0 - margin_rad + 1e-6), margin_rad));
    EXPECT_FALSE(turns_right.contains(wrap(2.0 - margin_rad - 1e-6), margin_rad));
  }
}

TEST(ViewInterval, MarginIsThreeStandardDeviations) { EXPECT_DOUBLE_EQ(view_margin_rad(0.0004, 0.0004, 0.0001), 0.09); }

}  // namespace
}  // namespace azimuth
