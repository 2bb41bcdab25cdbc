#include <cmath>
#include <gtest/gtest.h>
#include <span>
#include <utility>

#include "tests/tools/import/ros2_messages.hpp"
#include "tools/import/ros_message.hpp"

namespace azimuth::test {
namespace {

/// A message together with the bytes that it refers to.
struct Ros2Message {
  explicit Ros2Message(const RosType& type) : message(definition_of(type)) {}

  static RosDefinition definition_of(const RosType& type) {
    auto definition = RosDefinition::parse(type.definition, type.name, RosVersion::two);
    EXPECT_TRUE(definition) << type.name;
    return definition.value_or(RosDefinition());
  }
  bool load(std::string bytes) {
    kept = std::move(bytes);
    return message.read(std::as_bytes(std::span(kept.data(), kept.size())));
  }

  RosMessage message;
  std::string kept;
};

TEST(Ros2Definition, HasBoundsAndValuesThatNobodyNeeds) {
  const auto definition = RosDefinition::parse(
      "uint8 KIND=3\nstring NAME = \"a # b\"\nint16 a -4\nstring<=10 b \"none\"\nfloat64[<=3] c\nstring<=5[<=2] d\n"
      "own/msg/Inner e\nInner[2] f\n=====\nMSG: own/msg/Inner\nbool g true\n",
      "own/msg/Outer", RosVersion::two);
  ASSERT_TRUE(definition);
  CdrBytes bytes;
  bytes.u8(1).u8(0).text("bc").u32(2).f64(1.0).f64(2.0).u32(1).text("d").u8(1).u8(0).u8(1);
  const std::string cdr = bytes.bytes();
  std::string paths;
  EXPECT_TRUE(definition->read(std::as_bytes(std::span(cdr.data(), cdr.size())),
                               [&](std::string_view path, const RosDefinition::Value& value) {
                                 paths += std::string(path) + ':' + std::to_string(value.bytes.size()) + ' ';
                               }));
  EXPECT_EQ(paths, "a:2 b:2 c:16 d[0]:1 e.g:1 f[0].g:1 f[1].g:1 ");
  EXPECT_FALSE(RosDefinition::parse("int16 a -4\n", "own/Outer", RosVersion::one)) << "which ROS 1 has not";
}

TEST(Ros2Message, OfOdometryHasAPoseAndAStamp) {
  Ros2Message odometry(kRos2Odometry);
  ASSERT_TRUE(odometry.load(ros2_odometry(12.5, 1.0, -2.0, std::sin(0.25), std::cos(0.25))));
  EXPECT_EQ(odometry.message.time("header.stamp"), stamp_from_us(12'500'000));
  const auto pose = pose_of(odometry.message);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->x_m, 1.0);
  EXPECT_EQ(pose->y_m, -2.0);
  EXPECT_NEAR(pose->heading_rad, 0.5, 1e-12);
}

TEST(Ros2Message, OfAnImageHasItsPixels) {
  Ros2Message image(kRos2Image);
  ASSERT_TRUE(image.load(ros2_image(1.0, 3, 2, "mono8", 4, "abc.def.")));
  std::vector<std::byte> changed;
  const RosImage read = image_of(image.message, changed);
  EXPECT_EQ(read.image.format.width_px, 3);
  EXPECT_EQ(read.image.format.height_px, 2);
  EXPECT_EQ(read.image.format.pixels, PixelFormat::gray8);
  EXPECT_EQ(std::to_integer<char>(read.image.bytes[4]), 'd');
}

TEST(Ros2Message, OfJointsHasTheWheels) {
  Ros2Message joints(kRos2JointState);
  CdrBytes bytes;
  bytes.header(1.0, "").u32(2).text("wheel_left").text("wheel_right").u32(2).f64(1.5).f64(2.5).u32(0).u32(0);
  ASSERT_TRUE(joints.load(bytes.bytes()));
  const auto wheels = wheels_of(joints.message, "", "");
  ASSERT_TRUE(wheels);
  EXPECT_EQ(wheels->left_rad, 1.5);
  EXPECT_EQ(wheels->right_rad, 2.5);
}

TEST(Ros2Message, CutAnywhereIsRefused) {
  Ros2Message odometry(kRos2Odometry);
  const std::string whole = ros2_odometry(12.5, 1.0, 2.0, 0.0, 1.0);
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(odometry.load(whole.substr(0, size))) << size;
  EXPECT_TRUE(odometry.load(whole));
}

TEST(Ros2Message, InAnotherByteOrderIsRefused) {
  Ros2Message odometry(kRos2Odometry);
  std::string big = ros2_odometry(12.5, 1.0, 2.0, 0.0, 1.0);
  big[1] = 0;
  EXPECT_FALSE(odometry.load(big));
}

TEST(Ros2Message, OfATimeBefore1970HasNone) {
  Ros2Message odometry(kRos2Odometry);
  std::string early = ros2_odometry(1.0, 1.0, 2.0, 0.0, 1.0);
  early.replace(4, 4, "\xff\xff\xff\xff");
  ASSERT_TRUE(odometry.load(early));
  EXPECT_FALSE(odometry.message.time("header.stamp"));
}

}  // namespace
}  // namespace azimuth::test
