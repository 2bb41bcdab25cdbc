#include "sim/world/driver.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace azimuth {
namespace {

const Path kBlock = laps_round({{2.0, 2.0}, {12.0, 8.0}}, 1);

struct Driven {
  std::vector<Pose2> poses;
  std::vector<Control> controls;
};

Driven drive(const DriveSettings& settings, const Path& path) {
  const auto driver = make_driver(settings, path, Random(1, RandomPurpose::drive));
  Driven driven{{driver->start()}, {}};
  while (const auto control = driver->next(driven.poses.back())) {
    driven.controls.push_back(*control);
    driven.poses.push_back(driven.poses.back() * displacement(*control));
    if (driven.poses.size() > 1000000) ADD_FAILURE() << "never arrives";
    if (driven.poses.size() > 1000000) break;
  }
  return driven;
}

TEST(Displacement, IsTheMoveOfTheMotionModel) {
  const Pose2 T_world_body{1.0, -2.0, 2.5};
  const Control control{0.7, 0.9, -0.4};
  const Pose2 expected = move(T_world_body, control);
  const Pose2 composed = T_world_body * displacement(control);
  EXPECT_NEAR((expected.position() - composed.position()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(wrap(expected.heading_rad - composed.heading_rad), 0.0, 1e-12);
}

TEST(StepDriver, StopsNearThePathOneMetreApart) {
  const Driven driven = drive(StepDrive{}, kBlock);
  ASSERT_EQ(driven.controls.size(), 36u);
  double length_m = 0.0;
  for (std::size_t i = 0; i < driven.controls.size(); ++i) {
    EXPECT_LT(distance_to_path(driven.poses[i + 1].position(), kBlock), 0.5);
    length_m += driven.controls[i].distance_m;
  }
  EXPECT_NEAR(length_m / 36, 1.0, 0.06);
}

TEST(SmoothDriver, StaysOnThePathAndArrives) {
  for (const Path& path : {kBlock, there_and_back({0.0, 0.0}, {6.0, 0.0}, 2)}) {
    const Driven driven = drive(SmoothDrive{}, path);
    for (const Pose2& pose : driven.poses) ASSERT_LT(distance_to_path(pose.position(), path), 0.8);
    EXPECT_LT((driven.poses.back().position() - path.back()).norm(), 0.1);
  }
}

TEST(SmoothDriver, RespectsItsLimits) {
  const SmoothDrive settings;
  const Driven driven = drive(settings, kBlock);
  double speed = 0.0, fastest = 0.0;
  for (const Control& control : driven.controls) {
    const double next = control.distance_m / settings.tick_s;
    EXPECT_LE(next - speed, settings.acceleration_m_per_s2 * settings.tick_s + 1e-9);
    EXPECT_LE(std::abs(control.first_turn_rad + control.second_turn_rad),
              settings.max_turn_rate_rad_per_s * settings.tick_s + 1e-9);
    speed = next;
    fastest = std::max(fastest, next);
  }
  EXPECT_NEAR(fastest, settings.speed_m_per_s, 1e-6);
  EXPECT_LT(speed, 0.25);  // slows down towards the end
}

TEST(SmoothDriver, ReachesEveryCornerOfARandomPath) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed, RandomPurpose::scene);
    const Path path = wander({{0.0, 0.0}, {16.0, 16.0}}, 13, 5.0, random);
    const Driven driven = drive(SmoothDrive{}, path);
    for (const Eigen::Vector2d& corner : path) {
      const auto nearest =
          std::min_element(driven.poses.begin(), driven.poses.end(), [&](const Pose2& a, const Pose2& b) {
            return (a.position() - corner).norm() < (b.position() - corner).norm();
          });
      EXPECT_LT((nearest->position() - corner).norm(), 0.7) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace azimuth
