#include "sim/renderer/render_scene.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace azimuth {
namespace {

class EveryScenario : public ::testing::TestWithParam<std::string_view> {
 protected:
  Scenario scenario() const { return *scenario_named(GetParam(), 3); }
};
INSTANTIATE_TEST_SUITE_P(Scenarios, EveryScenario, ::testing::ValuesIn(kScenarioNames), [](const auto& each) {
  std::string name(each.param);
  std::ranges::replace(name, '-', '_');
  return name;
});

bool contains(const Rectangle& room, const Eigen::Vector2d& point) {
  return (point.array() > room.low_m.array()).all() && (point.array() < room.high_m.array()).all();
}

TEST_P(EveryScenario, HasACylinderAtEachLandmark) {
  const RenderScene scene = coloured_scene(scenario());
  const std::size_t landmarks = scenario().landmarks.size();
  ASSERT_EQ(scene.cylinders.size(), 2 * landmarks) << "each on a stand";
  for (std::size_t i = 0; i < landmarks; ++i) {
    EXPECT_EQ(scene.cylinders[i].p_world_m, scenario().landmarks[i].p_world_landmark_m);
    EXPECT_EQ(scene.cylinders[landmarks + i].high_m, scene.cylinders[i].low_m);
    EXPECT_TRUE(std::ranges::count(kPaints, scene.cylinders[i].paint) == 1);
  }
}

TEST_P(EveryScenario, HoldsEverythingInItsRoom) {
  const RenderScene scene = coloured_scene(scenario());
  for (const RenderCylinder& cylinder : scene.cylinders) EXPECT_TRUE(contains(scene.room, cylinder.p_world_m));
  for (const Eigen::Vector2d& corner : scenario().path) EXPECT_TRUE(contains(scene.room, corner));
  for (const RenderLamp& lamp : scene.lamps) EXPECT_TRUE(contains(scene.room, lamp.p_world_m));
  EXPECT_FALSE(scene.posters.empty());
  EXPECT_FALSE(scene.lamps.empty());
  for (const RenderPoster& poster : scene.posters) {
    const int axis = poster.wall == Wall::east || poster.wall == Wall::west ? 1 : 0;
    EXPECT_GE(poster.along_m - poster.width_m / 2, scene.room.low_m[axis]);
    EXPECT_LE(poster.along_m + poster.width_m / 2, scene.room.high_m[axis]);
    EXPECT_GT(poster.middle_m - poster.height_m / 2, 0.0);
    EXPECT_LT(poster.middle_m + poster.height_m / 2, scene.ceiling_m);
  }
}

TEST_P(EveryScenario, NeighboursDifferInColour) {
  const RenderScene scene = coloured_scene(scenario());
  const std::size_t landmarks = scenario().landmarks.size();
  int alike = 0;
  for (std::size_t i = 0; i < landmarks; ++i) {
    double nearest_m = std::numeric_limits<double>::max();
    PackedColour its_paint = 0;
    for (std::size_t j = 0; j < landmarks; ++j) {
      const double distance_m = (scene.cylinders[i].p_world_m - scene.cylinders[j].p_world_m).norm();
      if (i == j || distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      its_paint = scene.cylinders[j].paint;
    }
    alike += its_paint == scene.cylinders[i].paint ? 1 : 0;
  }
  EXPECT_LE(alike, static_cast<int>(landmarks) / 10);
}

TEST_P(EveryScenario, LampSceneShinesByItsLandmarksOnly) {
  const RenderScene scene = lamp_scene(scenario(), 6.5);
  EXPECT_EQ(scene.lamps.size(), scenario().landmarks.size());
  EXPECT_EQ(scene.ceiling_m, 6.5);
  EXPECT_LT(scene.ambient, 0.1);
  EXPECT_TRUE(scene.cylinders.empty());
}

}  // namespace
}  // namespace azimuth
