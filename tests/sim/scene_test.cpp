#include "sim/world/scene.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

const Rectangle kRoom{{0.0, 0.0}, {10.0, 6.0}};

TEST(Scene, LapsCloseTheLoop) {
  const Path path = laps_round({{1.0, 1.0}, {9.0, 5.0}}, 2);
  ASSERT_EQ(path.size(), 9u);
  EXPECT_EQ(path.front(), path.back());
  EXPECT_EQ(path[1], Eigen::Vector2d(9.0, 1.0));  // counter-clockwise
}

TEST(Scene, ThereAndBackEndsAtTheStart) {
  const Path path = there_and_back({0.0, 0.0}, {5.0, 0.0}, 3);
  EXPECT_EQ(path.size(), 7u);
  EXPECT_EQ(path.front(), path.back());
}

TEST(Scene, WanderKeepsLegsLongAndInside) {
  Random random(1, RandomPurpose::scene);
  const Path path = wander(kRoom, 20, 3.0, random);
  ASSERT_EQ(path.size(), 20u);
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_GE((path[i] - path[i - 1]).norm(), 3.0);
    EXPECT_TRUE((path[i].array() >= kRoom.low_m.array()).all() && (path[i].array() <= kRoom.high_m.array()).all());
  }
}

TEST(Scene, WanderHasAllItsCornersHoweverMany) {
  Random random(1, RandomPurpose::scene);
  EXPECT_EQ(wander(kRoom, 3000, 3.0, random).size(), 3000u);
}

TEST(Scene, DistanceToPathIsToTheNearestSegment) {
  const Path path{{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}};
  EXPECT_DOUBLE_EQ(distance_to_path({2.0, 1.0}, path), 1.0);
  EXPECT_DOUBLE_EQ(distance_to_path({7.0, 7.0}, path), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_path({-3.0, 4.0}, path), 5.0);
}

TEST(Scene, ScatterKeepsItsSpacing) {
  Random random(2, RandomPurpose::scene);
  const Path path{{1.0, 3.0}, {9.0, 3.0}};
  const auto landmarks = scatter(kRoom, 15, {0.8, 0.6}, path, random);
  ASSERT_EQ(landmarks.size(), 15u);
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    EXPECT_EQ(landmarks[i].identity, static_cast<Identity>(i));
    EXPECT_GE(distance_to_path(landmarks[i].p_world_landmark_m, path), 0.6);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((landmarks[i].p_world_landmark_m - landmarks[j].p_world_landmark_m).norm(), 0.8);
  }
}

TEST(Scene, ScatterGivesUpWhereNothingFits) {
  Random random(3, RandomPurpose::scene);
  const auto landmarks = scatter({{0.0, 0.0}, {1.0, 1.0}}, 50, {0.9, 0.0}, {}, random);
  EXPECT_GE(landmarks.size(), 1u);
  EXPECT_LE(landmarks.size(), 4u);
}

TEST(Scene, WallsAreLinedInside) {
  Random random(4, RandomPurpose::scene);
  const auto landmarks = line_walls(kRoom, 2.0, 0.5, random);
  EXPECT_EQ(landmarks.size(), 16u);  // 5 + 3 + 5 + 3
  for (const WorldLandmark& landmark : landmarks) {
    const Eigen::Vector2d& p = landmark.p_world_landmark_m;
    const double to_wall = std::min({p.x(), p.y(), 10.0 - p.x(), 6.0 - p.y()});
    EXPECT_GE(to_wall, 0.0);
    EXPECT_LE(to_wall, 0.5);
  }
}

}  // namespace
}  // namespace azimuth
