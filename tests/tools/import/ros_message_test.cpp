#include "tools/import/ros_message.hpp"

#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/cpu_time.hpp"
#include "tests/tools/import/ros_messages.hpp"

namespace azimuth::test {
namespace {

Bytes bytes_of(const std::string& text) { return std::as_bytes(std::span(text.data(), text.size())); }

/// Reads `bytes` into the message, which refers to them. The function keeps them until its next call.
bool load(RosMessage& message, std::string bytes) {
  static std::string kept;
  kept = std::move(bytes);
  return message.read(bytes_of(kept));
}

RosMessage message_of(const RosType& type) {
  auto definition = RosDefinition::parse(type.definition, type.name);
  EXPECT_TRUE(definition) << type.name;
  return RosMessage(definition.value_or(RosDefinition()));
}

TEST(RosDefinition, NamesEveryValueOfAMessageInTheirOrder) {
  const auto definition = RosDefinition::parse(
      "uint8 KIND=3 # a constant\nstring NAME= # not a comment\nint16 a\nInner[2] b\nstring[] c\nfloat32[3] d\n"
      "================\nMSG: own/Inner\nbool e\n",
      "own/Outer");
  ASSERT_TRUE(definition);
  RosBytes bytes;
  bytes.u8(0xfe).u8(0xff).u8(1).u8(0).u32(2).text("one").text("").u32(0).u32(0).u32(0);
  std::string paths;
  EXPECT_TRUE(definition->read(bytes_of(bytes.bytes()), [&](std::string_view path, const RosDefinition::Value& value) {
    paths += std::string(path) + ':' + std::to_string(value.count) + ' ';
  }));
  EXPECT_EQ(paths, "a:1 b[0].e:1 b[1].e:1 c[0]:1 c[1]:1 d:3 ");
}

TEST(RosDefinition, RefusesWhatIsNone) {
  EXPECT_FALSE(RosDefinition::parse("uint8", "a/B"));
  EXPECT_FALSE(RosDefinition::parse("uint8 a b", "a/B"));
  EXPECT_FALSE(RosDefinition::parse("uint8[-1] a", "a/B"));
  EXPECT_FALSE(RosDefinition::parse("uint8[x a", "a/B"));
  EXPECT_FALSE(RosDefinition::parse("Unknown a", "a/B"));
  EXPECT_FALSE(RosDefinition::parse("uint8 a\n=====\nuint8 b\n", "a/B"));
  EXPECT_TRUE(RosDefinition::parse("", "std_msgs/Empty"));
}

TEST(RosDefinition, EndsWhereATypeHoldsItself) {
  const auto endless = RosDefinition::parse("B b\n", "a/B");
  ASSERT_TRUE(endless);
  EXPECT_FALSE(endless->read(Bytes{}, [](std::string_view, const RosDefinition::Value&) {}));
  const auto wide = RosDefinition::parse("B[1000000000] b\n=====\nMSG: a/B\n", "a/A");
  ASSERT_TRUE(wide);
  EXPECT_FALSE(wide->read(Bytes{}, [](std::string_view, const RosDefinition::Value&) {}));
}

TEST(RosDefinition, RefusesWhatOnlyAnAttackerWrites) {
  const std::string name(300, 'n');
  EXPECT_FALSE(RosDefinition::parse("uint8 " + name, "a/B"));
  EXPECT_FALSE(RosDefinition::parse(name + " a\n=====\nMSG: " + name + "\n", "a/B"));
  EXPECT_FALSE(RosDefinition::parse("=====\nMSG: a/" + name + "\n", "a/B"));
  EXPECT_FALSE(RosDefinition::parse("", name));
  EXPECT_FALSE(RosDefinition::parse(std::string(600'000, '#'), "a/B"));
  std::string bounds = "string";
  for (int i = 0; i < 150'000; ++i) bounds += "<=9";
  const double begin_s = cpu_time_s();
  EXPECT_TRUE(RosDefinition::parse(bounds + " a", "a/B", RosVersion::two));
  EXPECT_LT(cpu_time_s() - begin_s, 1.0);
}

TEST(RosDefinition, ValuesThatTakeNoBytesAreFew) {
  const auto nothing = RosDefinition::parse("B[300] b\n=====\nMSG: a/B\n", "a/A");
  ASSERT_TRUE(nothing);
  const auto use = [](std::string_view, const RosDefinition::Value&) {};
  EXPECT_FALSE(nothing->read(bytes_of(std::string(100, 'x')), use));
  EXPECT_TRUE(nothing->read(bytes_of(std::string(600, 'x')), use)) << "as many as a message of its size may have";
}

TEST(RosDefinition, APathHasAnEnd) {
  std::string types;
  const std::string name(250, 'n');
  for (int i = 0; i < 8; ++i)
    types += "T" + std::to_string(i + 1) + ' ' + name + "\n=====\nMSG: a/T" + std::to_string(i + 1) + '\n';
  const auto deep = RosDefinition::parse(types + "uint8 a\n", "a/T0");
  ASSERT_TRUE(deep);
  EXPECT_FALSE(deep->read(bytes_of(std::string(1000, 'x')), [](std::string_view, const RosDefinition::Value&) {}));
}

TEST(RosMessage, CutAnywhereIsRefused) {
  RosMessage message = message_of(kOdometryType);
  const std::string whole = odometry_bytes(12.5, 1.0, 2.0, 0.0, 1.0);
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(load(message, whole.substr(0, size))) << size;
  EXPECT_TRUE(load(message, whole));
}

TEST(RosMessage, OfOdometryHasAPoseAndAStamp) {
  RosMessage message = message_of(kOdometryType);
  ASSERT_TRUE(load(message, odometry_bytes(12.5, 1.0, -2.0, std::sin(0.25), std::cos(0.25))));
  EXPECT_EQ(message.time("header.stamp"), stamp_from_us(12'500'000));
  const auto pose = pose_of(message);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->position(), Eigen::Vector2d(1.0, -2.0));
  EXPECT_NEAR(pose->heading_rad, 0.5, 1e-12);
}

TEST(RosMessage, OfAPoseThatCannotBeTrueHasNone) {
  RosMessage message = message_of(kPoseStampedType);
  for (const auto& [x_m, qw] : std::vector<std::pair<double, double>>{{0.0, 0.0}, {1e9, 1.0}, {std::nan(""), 1.0}}) {
    ASSERT_TRUE(load(message, RosBytes().header(1.0).pose(x_m, 0.0, 0.0, qw).bytes()));
    EXPECT_FALSE(pose_of(message)) << x_m << ' ' << qw;
  }
  ASSERT_TRUE(load(message, RosBytes().header(0.0).pose(1.0, 0.0, 0.0, 1.0).bytes()));
  EXPECT_TRUE(pose_of(message));
  EXPECT_FALSE(message.time("header.stamp")) << "nobody set it";
}

RosImage image_of(const RosMessage& message) {
  static std::vector<std::byte> changed;
  return azimuth::image_of(message, changed);
}

TEST(RosMessage, OfAnImageHasItsPixels) {
  RosMessage message = message_of(kImageType);
  ASSERT_TRUE(load(message, image_bytes(1.0, 2, 2, "bgr8", 8, "abcdef--ghijkl--")));
  const RosImage image = image_of(message);
  EXPECT_EQ(image.image.format, (FrameFormat{PixelFormat::bgr8, 2, 2, 8}));
  EXPECT_EQ(image.image.bytes.size(), 16u);
  EXPECT_EQ(image.image.bytes[8], std::byte{'g'});
}

TEST(RosMessage, OfAnImageByNamesSinceIronHasItsPixels) {
  RosMessage message = message_of(kImageType);
  for (const auto& [encoding, pixels] :
       std::vector<std::pair<std::string, PixelFormat>>{{"yuyv", PixelFormat::yuyv},
                                                        {"yuv422_yuy2", PixelFormat::yuyv},
                                                        {"uyvy", PixelFormat::uyvy},
                                                        {"yuv422", PixelFormat::uyvy}}) {
    ASSERT_TRUE(load(message, image_bytes(1.0, 2, 1, encoding, 4, "abcd")));
    EXPECT_EQ(image_of(message).image.format, packed_format(pixels, 2, 1)) << encoding;
  }
}

TEST(RosMessage, OfAWideImageHasWhatCanBeRead) {
  RosMessage message = message_of(kImageType);
  const auto pixels = [&](const std::string& encoding, std::uint32_t step, const std::string& data) {
    EXPECT_TRUE(load(message, image_bytes(1.0, 2, 2, encoding, step, data)));
    const RosImage image = image_of(message);
    EXPECT_EQ(image.unsupported, "");
    return std::string(as_text(image.image.bytes));
  };
  EXPECT_EQ(pixels("rgba8", 9, "rgb.RGB.-uvw.UVW.-"), "rgbRGBuvwUVW");
  EXPECT_EQ(image_of(message).image.format, packed_format(PixelFormat::rgb8, 2, 2));
  EXPECT_EQ(pixels("bgra8", 8, "bgr.BGR.uvw.UVW."), "bgrBGRuvwUVW");
  EXPECT_EQ(image_of(message).image.format.pixels, PixelFormat::bgr8);
  EXPECT_EQ(pixels("mono16", 4, ".a.b.c.d"), "abcd") << "the upper byte, which comes second";
  EXPECT_EQ(image_of(message).image.format.pixels, PixelFormat::gray8);
  EXPECT_EQ(pixels("mono16", 4, ".a.b.c."), "") << "too few bytes";
  EXPECT_EQ(pixels("mono16", 3, ".a.b.c.d"), "") << "rows that overlap";
  EXPECT_EQ(pixels("rgba8", 0, ""), "");
}

TEST(RosMessage, OfOdometryTellsWhatWasNeverSet) {
  RosMessage message = message_of(kOdometryType);
  ASSERT_TRUE(load(message, odometry_bytes(12.5, 1.0, 2.0, 0.0, 0.0)));
  EXPECT_TRUE(has_unset_orientation(message));
  EXPECT_FALSE(pose_of(message));
  EXPECT_EQ(frames_of(message), "odom -> base");
  EXPECT_EQ(twist_of(message)->speed_m_s, 0.0);
  ASSERT_TRUE(load(message, odometry_bytes(12.5, 1.0, 2.0, 0.0, 1.0)));
  EXPECT_FALSE(has_unset_orientation(message));
}

TEST(RosMessage, OfAnImageThatCannotBeReadSaysSo) {
  RosMessage message = message_of(kImageType);
  ASSERT_TRUE(load(message, image_bytes(1.0, 2, 2, "32FC1", 8, "abcdefghijklmnop")));
  EXPECT_EQ(image_of(message).unsupported, "32FC1");
  ASSERT_TRUE(load(message, image_bytes(1.0, 2, 2, "mono8", 2, "abc")));
  EXPECT_TRUE(image_of(message).image.bytes.empty()) << "too few bytes";
  EXPECT_EQ(image_of(message).unsupported, "");
  ASSERT_TRUE(load(message, image_bytes(1.0, 4'000'000'000, 4'000'000'000, "mono8", 2, "abc")));
  EXPECT_TRUE(image_of(message).image.bytes.empty());
}

TEST(RosMessage, OfJointsHasTwoWheels) {
  RosMessage message = message_of(kJointStateType);
  ASSERT_TRUE(load(message, joints_bytes(1.0, {{"arm", 9.0}, {"Wheel_Right", 2.0}, {"wheel_left", 1.0}})));
  const auto angles = wheels_of(message, "", "");
  ASSERT_TRUE(angles);
  EXPECT_EQ(angles->left_rad, 1.0);
  EXPECT_EQ(angles->right_rad, 2.0);
  EXPECT_TRUE(wheels_of(message, "arm", "wheel_left"));
  EXPECT_FALSE(wheels_of(message, "arm", "leg"));
  ASSERT_TRUE(load(message, joints_bytes(1.0, {{"left_1", 9.0}, {"left_2", 2.0}, {"right", 1.0}})));
  EXPECT_FALSE(wheels_of(message, "", "")) << "two are on the left";
  EXPECT_EQ(joints_of(message), "left_1, left_2, right");
}

}  // namespace
}  // namespace azimuth::test
