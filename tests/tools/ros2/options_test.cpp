#include "tools/ros2/bridge/options.hpp"

#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace azimuth::test {
namespace {

ParsedRos2Options parse(std::vector<const char*> words, std::map<std::string, std::string> variables = {}) {
  words.insert(words.begin(), "azimuth-ros2");
  return parse_ros2_options(static_cast<int>(words.size()), words.data(),
                            [&](const char* name) { return variables[name]; });
}

TEST(Ros2Options, AreThoseThatRos2UsersExpect) {
  const ParsedRos2Options parsed = parse({});
  EXPECT_FALSE(parsed.exit_code);
  EXPECT_EQ(parsed.options.domain, 0u);
  EXPECT_EQ(parsed.options.interface, "");
  EXPECT_EQ(parsed.options.bridge.frames.map, "map");
  EXPECT_EQ(parsed.options.bridge.frames.odom, "odom");
  EXPECT_EQ(parsed.options.bridge.frames.base, "base_link");
  EXPECT_EQ(parsed.options.bridge.transforms, TransformChoice::full);
}

TEST(Ros2Options, TakeTheDomainFromTheEnvironment) {
  EXPECT_EQ(parse({}, {{"ROS_DOMAIN_ID", "17"}}).options.domain, 17u);
  EXPECT_EQ(parse({"--domain", "3"}, {{"ROS_DOMAIN_ID", "17"}}).options.domain, 3u);
  for (const char* wrong : {"x", "-1", "233", "1 "}) EXPECT_EQ(parse({}, {{"ROS_DOMAIN_ID", wrong}}).exit_code, 2);
  EXPECT_EQ(parse({"--domain", "233"}).exit_code, 2);
}

TEST(Ros2Options, StayOnTheMachineWhereRosSaysSo) {
  EXPECT_EQ(parse({}, {{"ROS_LOCALHOST_ONLY", "1"}}).options.interface, "lo");
  EXPECT_EQ(parse({}, {{"ROS_LOCALHOST_ONLY", "0"}}).options.interface, "");
  EXPECT_EQ(parse({}, {{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}}).options.interface, "lo");
  EXPECT_EQ(parse({}, {{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}}).options.interface, "");
}

TEST(Ros2Options, RefuseWhatIsNotThere) {
  EXPECT_EQ(parse({"--interface", "nowhere0"}).exit_code, 2);
  EXPECT_FALSE(parse({"--interface", "lo"}).exit_code);
  EXPECT_EQ(parse({"--lcm-url", "memq://"}).exit_code, 2);
  EXPECT_EQ(parse({"--tf", "all"}).exit_code, 2);
  EXPECT_EQ(parse({"--frames", "x"}).exit_code, 2);
}

TEST(Ros2Options, NameFramesTransformsAndChannels) {
  const Ros2Options options = parse({"--map-frame", "world", "--odom-frame", "o", "--base-frame", "b", "--tf",
                                     "map-odom", "--prefix", "R1_", "--lcm-url", "udpm://239.1.2.3:5000"})
                                  .options;
  EXPECT_EQ(options.bridge.frames.map, "world");
  EXPECT_EQ(options.bridge.frames.odom, "o");
  EXPECT_EQ(options.bridge.frames.base, "b");
  EXPECT_EQ(options.bridge.transforms, TransformChoice::map_odom);
  EXPECT_EQ(options.bridge.channel_prefix, "R1_");
  EXPECT_EQ(options.bridge.lcm_url, "udpm://239.1.2.3:5000");
}

}  // namespace
}  // namespace azimuth::test
