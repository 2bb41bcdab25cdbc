#include "drivers/ros/serialize.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace azimuth::ros {
namespace {

constexpr Stamp kStamp = stamp_from_us(1'700'000'000'250'001);

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number{};
  EXPECT_LE(at + sizeof number, bytes.size());
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

PoseWithCovarianceStamped a_pose() {
  PoseWithCovarianceStamped message{{kStamp, "map"}, {{1.5, 2.5, 0.0}, {0.0, 0.0, 0.6, 0.8}}, {}};
  for (std::size_t i = 0; i < 36; ++i) message.covariance[i] = static_cast<double>(i);
  return message;
}

TEST(Ros1Bytes, StandOneBehindTheOther) {
  const std::string bytes = ros1_bytes(a_pose());
  ASSERT_EQ(bytes.size(), 4 + 8 + 4 + 3 + 8 * (7 + 36u));
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 4), 1'700'000'000u);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), 250'001'000u);
  EXPECT_EQ(bytes.substr(12, 7), std::string("\x03\0\0\0map", 7));
  EXPECT_EQ(number_at<double>(bytes, 19), 1.5);
  EXPECT_EQ(number_at<double>(bytes, 19 + 6 * 8), 0.8);
  EXPECT_EQ(number_at<double>(bytes, 19 + (7 + 35) * 8), 35.0);
}

TEST(Ros2Bytes, AreAlignedBehindTheirHeader) {
  const std::string bytes = ros2_bytes(a_pose());
  EXPECT_EQ(bytes.substr(0, 4), std::string("\0\x01\0\0", 4)) << "CDR, little-endian";
  EXPECT_EQ(number_at<std::int32_t>(bytes, 4), 1'700'000'000);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), 250'001'000u);
  EXPECT_EQ(bytes.substr(12, 8), std::string("\x04\0\0\0map\0", 8));
  EXPECT_EQ(number_at<double>(bytes, 4 + 16), 1.5);
  ASSERT_EQ(bytes.size(), 4 + 16 + 8 * (7 + 36u));

  PoseWithCovarianceStamped longer = a_pose();
  longer.header.frame_id = "maps";
  EXPECT_EQ(number_at<double>(ros2_bytes(longer), 4 + 24), 1.5) << "a letter more moves doubles by eight bytes";
}

TEST(Ros2Bytes, OfAMarkerHaveWhatRos2Added) {
  MarkerArray message;
  message.markers.emplace_back().header = {kStamp, "map"};
  const std::size_t one = ros1_bytes(message).size(), two = ros2_bytes(message).size();
  EXPECT_GT(two, one + 20);
}

TEST(RosTime, RoundsSecondsDown) {
  EXPECT_EQ(ros_time(stamp_from_us(-1)).seconds, -1);
  EXPECT_EQ(ros_time(stamp_from_us(-1)).nanoseconds, 999'999'000u);
  EXPECT_EQ(ros_time(stamp_from_us(-1'000'000)).seconds, -1);
  EXPECT_EQ(ros_time(stamp_from_us(-1'000'000)).nanoseconds, 0u);
  EXPECT_EQ(ros_time(stamp_from_us(1'999'999)).seconds, 1);
}

TEST(RosTime, FitsWhatEachRosCounts) {
  EXPECT_FALSE(fits_ros1(stamp_from_us(-1)));
  EXPECT_TRUE(fits_ros1(stamp_from_us(0)));
  EXPECT_TRUE(fits_ros1(stamp_from_us(4'294'967'295'999'999)));
  EXPECT_FALSE(fits_ros1(stamp_from_us(4'294'967'296'000'000)));
  EXPECT_FALSE(fits_ros2(stamp_from_us(-1)));
  EXPECT_TRUE(fits_ros2(stamp_from_us(2'147'483'647'999'999)));
  EXPECT_FALSE(fits_ros2(stamp_from_us(2'147'483'648'000'000)));
}

TEST(RosTime, OfZeroIsNotTheOneThatNobodySet) {
  const PoseWithCovarianceStamped message{{stamp_from_us(0), "map"}, {}, {}};
  EXPECT_EQ(number_at<std::uint32_t>(ros1_bytes(message), 8), 1u);
  EXPECT_EQ(number_at<std::uint32_t>(ros2_bytes(message), 8), 1u);
}

}  // namespace
}  // namespace azimuth::ros
