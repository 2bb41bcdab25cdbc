#include "drivers/ros/definitions.hpp"

#include <array>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>

namespace azimuth::ros {
namespace {

constexpr std::array kTypes{Type::pose, Type::odometry, Type::transforms, Type::path, Type::markers, Type::diagnostics};

/// The names of the definition's parts except the first, and all types that its fields use.
struct Names {
  std::set<std::string> parts, used;
};

Names names_in(const std::string& definition) {
  static const std::set<std::string> kScalars{"bool",    "byte",    "uint8",  "int32", "uint32",
                                              "float32", "float64", "string", "time",  "duration"};
  Names names;
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("MSG: ")) names.parts.insert(line.substr(5));
    if (line.starts_with("MSG: ") || line.starts_with("=")) continue;
    const std::string type = line.substr(0, std::min(line.find(' '), line.find('[')));
    if (!kScalars.contains(type)) names.used.insert(type);
  }
  return names;
}

TEST(Definitions, HoldAllThatTheyAreMadeOfAndNothingElse) {
  for (const Type type : kTypes) {
    for (const std::string& definition : {ros1_type(type).definition, ros2_type(type).definition}) {
      const Names names = names_in(definition);
      EXPECT_EQ(names.parts, names.used) << definition;
      EXPECT_FALSE(definition.starts_with("="));
    }
  }
}

TEST(Definitions, OfRos2HaveItsNamesOfTypes) {
  for (const Type type : kTypes) {
    const std::string one(ros1_type(type).name), two(ros2_type(type).name);
    const std::size_t slash = one.find('/');
    EXPECT_EQ(two, one.substr(0, slash) + "/msg" + one.substr(slash));
  }
}

TEST(Definitions, DifferWhereRos2Does) {
  EXPECT_NE(ros1_type(Type::pose).definition.find("uint32 seq\ntime stamp\n"), std::string::npos);
  EXPECT_EQ(ros2_type(Type::pose).definition.find("uint32 seq"), std::string::npos);
  EXPECT_NE(ros2_type(Type::pose).definition.find("builtin_interfaces/Time stamp\n"), std::string::npos);
  EXPECT_EQ(ros1_type(Type::markers).definition.find("mesh_file"), std::string::npos);
  EXPECT_NE(ros2_type(Type::markers).definition.find("visualization_msgs/MeshFile mesh_file\n"), std::string::npos);
}

}  // namespace
}  // namespace azimuth::ros
