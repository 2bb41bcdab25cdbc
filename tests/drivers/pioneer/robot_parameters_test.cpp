// The table of known robots; unknown robots must not get guessed parameters.

#include "drivers/pioneer/robot_parameters.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/support/places.hpp"

namespace azimuth::pioneer {
namespace {

double mm_per_unit(std::string_view subclass) { return 1e3 * find_robot_parameters(subclass)->distance_m_per_unit; }

TEST(PioneerRobotParameters, OfEachKind) {
  const std::vector<std::pair<std::vector<std::string_view>, double>> table{
      {{"p3dx-sh", "p3at-sh", "p3atiw-sh", "amigo-sh", "patrolbot-sh", "peoplebot-sh", "powerbot-sh", "wheelchair-sh",
        "p3dx-sh-lms1xx", "p3at-sh-lms500", "amigo-sh-tim3xx", "powerbot-sh-uarcs"},
       1.0},
      {{"pioneer-lx", "mt400", "researchPB", "seekur", "seekurjr"}, 1.0},
      {{"amigo"}, 0.5083},
      {{"p2de"}, 0.969},
      {{"p2ce"}, 0.826},
      {{"p2pb"}, 0.424},
      {{"p2pp", "p2df", "p2d8", "p2d8+", "perfpb", "perfpb+", "p3dx"}, 0.485},
      {{"p2it"}, 1.136},
      {{"p2at", "p2at8"}, 1.32},
      {{"p2at8+", "p3at"}, 0.465},
      {{"p2dx"}, 0.84},
      {{"powerbot"}, 0.5813},
      {{"pion1m", "pion1x", "psos1m", "psos1x", "psos43m"}, 0.05066},
      {{"pionat"}, 0.07},
  };
  for (const auto& [subclasses, expected] : table) {
    for (const std::string_view subclass : subclasses) {
      ASSERT_TRUE(find_robot_parameters(subclass)) << subclass;
      EXPECT_DOUBLE_EQ(mm_per_unit(subclass), expected) << subclass;
    }
  }
}

/// The rows `| kind | mm | units |` of docs/pioneer.md.
std::vector<std::pair<std::string, RobotParameters>> documented_kinds() {
  std::ifstream document(azimuth::test::source_folder() / "docs/pioneer.md");
  std::vector<std::pair<std::string, RobotParameters>> kinds;
  for (std::string line; std::getline(document, line);) {
    std::istringstream row(line);
    std::string bar, kind;
    double mm = 0.0, units = 0.0;
    if (!(row >> bar >> kind >> bar >> mm >> bar >> units) || bar != "|") continue;
    kinds.push_back({kind, {.distance_m_per_unit = 0.001 * mm, .heading_units_per_turn = units}});
  }
  return kinds;
}

TEST(PioneerRobotParameters, AreThoseOfTheDocument) {
  std::string all;
  for (const auto& [kind, parameters] : documented_kinds()) {
    const auto found = find_robot_parameters(kind);
    ASSERT_TRUE(found) << kind;
    EXPECT_DOUBLE_EQ(found->distance_m_per_unit, parameters.distance_m_per_unit) << kind;
    EXPECT_EQ(found->heading_units_per_turn, parameters.heading_units_per_turn) << kind;
    all += kind + ", ";
  }
  EXPECT_THAT(known_subclasses(), testing::StartsWith(all + "and")) << "all of them, and no others";
}

TEST(PioneerRobotParameters, OnlyTheFirstGenerationHasCoarserHeadings) {
  for (const char* subclass : {"pion1m", "pion1x", "pionat", "psos1m", "psos1x", "psos43m"}) {
    EXPECT_DOUBLE_EQ(find_robot_parameters(subclass)->heading_units_per_turn, 1024.0);
    EXPECT_DOUBLE_EQ(find_robot_parameters(subclass)->velocity_m_s_per_unit, 2.5332e-3);
  }
  for (const char* subclass : {"p3dx-sh", "amigo", "p2at8", "powerbot", "seekur"})
    EXPECT_DOUBLE_EQ(find_robot_parameters(subclass)->heading_units_per_turn, 4096.0);
}

TEST(PioneerRobotParameters, CaseDoesNotMatter) {
  for (const char* subclass : {"P3DX", "P3DX-SH", "ResearchPB", "PIONEER-LX", "Seekurjr", "p2D8+"})
    EXPECT_TRUE(find_robot_parameters(subclass)) << subclass;
}

TEST(PioneerRobotParameters, UnknownKindsAreNotGuessed) {
  for (const char* subclass : {"", "-sh", "-sh-lms500", "p3dx-s", "p3", "seekurjr2", "p3dx-sh2", "p2d8++", "hexapod"})
    EXPECT_FALSE(find_robot_parameters(subclass)) << subclass;
  EXPECT_THAT(known_subclasses(), testing::AllOf(testing::HasSubstr("p3dx-sh"), testing::HasSubstr("pion1m")));
}

TEST(PioneerRobotParameters, SettingsComeFirst) {
  PioneerSettings settings;
  EXPECT_FALSE(robot_parameters(settings, "hexapod"));
  settings.subclass = "p3at";
  EXPECT_DOUBLE_EQ(robot_parameters(settings, "hexapod")->distance_m_per_unit, 0.465e-3);
  settings.heading_units_per_turn = 4106.0;
  EXPECT_DOUBLE_EQ(robot_parameters(settings, "p3dx-sh")->heading_units_per_turn, 4106.0);
  settings.subclass = "nothing known";
  EXPECT_FALSE(robot_parameters(settings, "p3dx-sh"));
  settings.distance_mm_per_unit = 0.9;
  EXPECT_DOUBLE_EQ(robot_parameters(settings, "p3dx-sh")->distance_m_per_unit, 0.9e-3);
}

}  // namespace
}  // namespace azimuth::pioneer
