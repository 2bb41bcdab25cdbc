// Which robots are known, and that others are not guessed.

#include "drivers/pioneer/robot_parameters.hpp"

#include <gmock/gmock.h>

namespace azimuth::pioneer {
namespace {

double mm_per_unit(std::string_view subclass) { return 1e3 * find_robot_parameters(subclass)->distance_m_per_unit; }

TEST(PioneerRobotParameters, OfEachKind) {
  EXPECT_DOUBLE_EQ(mm_per_unit("p3dx-sh"), 1.0);
  EXPECT_DOUBLE_EQ(mm_per_unit("p3at-sh"), 1.0);
  EXPECT_DOUBLE_EQ(mm_per_unit("powerbot-sh"), 1.0);
  EXPECT_DOUBLE_EQ(mm_per_unit("p3dx"), 0.485);
  EXPECT_DOUBLE_EQ(mm_per_unit("P3DX"), 0.485);
  EXPECT_DOUBLE_EQ(mm_per_unit("p3at"), 0.465);
  EXPECT_DOUBLE_EQ(mm_per_unit("p2dx"), 0.84);
  EXPECT_DOUBLE_EQ(mm_per_unit("p2at"), 1.32);
  EXPECT_DOUBLE_EQ(mm_per_unit("pion1m"), 0.05066);
  EXPECT_DOUBLE_EQ(find_robot_parameters("pion1m")->heading_units_per_turn, 1024.0);
  EXPECT_DOUBLE_EQ(find_robot_parameters("p3dx-sh")->heading_units_per_turn, 4096.0);
}

TEST(PioneerRobotParameters, UnknownKindsAreNotGuessed) {
  for (const char* subclass : {"", "-sh", "p3dx-s", "p3", "seekurjr", "p3dx-sh2"})
    EXPECT_FALSE(find_robot_parameters(subclass)) << subclass;
  EXPECT_THAT(known_subclasses(), testing::AllOf(testing::HasSubstr("p3dx-sh"), testing::HasSubstr("pion1m")));
}

TEST(PioneerRobotParameters, SettingsComeFirst) {
  PioneerSettings settings;
  EXPECT_FALSE(robot_parameters(settings, "seekurjr"));
  settings.subclass = "p3at";
  EXPECT_DOUBLE_EQ(robot_parameters(settings, "seekurjr")->distance_m_per_unit, 0.465e-3);
  settings.heading_units_per_turn = 4106.0;
  EXPECT_DOUBLE_EQ(robot_parameters(settings, "p3dx-sh")->heading_units_per_turn, 4106.0);
  settings.subclass = "nothing known";
  EXPECT_FALSE(robot_parameters(settings, "p3dx-sh"));
  settings.distance_mm_per_unit = 0.9;
  EXPECT_DOUBLE_EQ(robot_parameters(settings, "p3dx-sh")->distance_m_per_unit, 0.9e-3);
}

}  // namespace
}  // namespace azimuth::pioneer
