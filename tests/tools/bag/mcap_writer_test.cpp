// Tests the details of MCAP files that read_mcap.py does not check; foreign_readers_test.cpp runs that reader.

#include "tools/bag/mcap_writer.hpp"

#include <gtest/gtest.h>
#include <string>

namespace azimuth::test {
namespace {

TEST(McapWriter, BeginsAndEndsWithItsMagic) {
  McapWriter writer("ros2", "test");
  const std::string file = writer.finish();
  const std::string magic("\x89MCAP0\r\n", 8);
  EXPECT_TRUE(file.starts_with(magic));
  EXPECT_TRUE(file.ends_with(magic));
}

TEST(McapWriter, HasAHeaderAsTheSpecificationHasIt) {
  McapWriter writer("ros2", "test");
  EXPECT_EQ(writer.finish().substr(8, 9 + 16),
            std::string("\x01\x10\0\0\0\0\0\0\0\x04\0\0\0ros2\x04\0\0\0test", 9 + 16));
}

TEST(McapWriter, NumbersSchemasFromOneAndChannelsFromZero) {
  McapWriter writer("", "");
  EXPECT_EQ(writer.add_schema("a", "ros2msg", ""), 1);
  EXPECT_EQ(writer.add_schema("b", "ros2msg", ""), 2);
  EXPECT_EQ(writer.add_channel(2, "/b", "cdr", {}), 0);
  EXPECT_EQ(writer.add_channel(1, "/a", "cdr", {}), 1);
}

}  // namespace
}  // namespace azimuth::test
