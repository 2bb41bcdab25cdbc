#include "tests/tools/import/bag_writer.hpp"

#include <cstdlib>
#include <cstring>
#include <functional>
#include <rosbag/bag.h>
#include <string>

namespace azimuth::test {
namespace {

/// A message with the type information that the ROS library asks for. The checksum only has to differ between types.
struct Sent {
  std::string type, definition, checksum, bytes;
};

}  // namespace
}  // namespace azimuth::test

namespace ros::message_traits {

template <>
struct MD5Sum<azimuth::test::Sent> {
  static const char* value(const azimuth::test::Sent& sent) { return sent.checksum.c_str(); }
};
template <>
struct DataType<azimuth::test::Sent> {
  static const char* value(const azimuth::test::Sent& sent) { return sent.type.c_str(); }
};
template <>
struct Definition<azimuth::test::Sent> {
  static const char* value(const azimuth::test::Sent& sent) { return sent.definition.c_str(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
struct Serializer<azimuth::test::Sent> {
  template <class Stream>
  static void write(Stream& stream, const azimuth::test::Sent& sent) {
    const auto size = static_cast<std::uint32_t>(sent.bytes.size());
    if (size > 0) std::memcpy(stream.advance(size), sent.bytes.data(), size);
  }
  static std::uint32_t serializedLength(const azimuth::test::Sent& sent) {
    return static_cast<std::uint32_t>(sent.bytes.size());
  }
};

}  // namespace ros::serialization

namespace azimuth::test {

bool can_write_bags() { return true; }

void write_bag(const std::filesystem::path& file, const std::vector<BagMessage>& messages, BagCompression compression) {
  console_bridge::noOutputHandler();
  ::setenv("ROS_HOME", file.parent_path().c_str(), 1);  // otherwise the library writes to the home folder
  rosbag::Bag bag(file.string(), rosbag::bagmode::Write);
  bag.setChunkThreshold(2000);
  if (compression == BagCompression::bz2) bag.setCompression(rosbag::compression::BZ2);
  if (compression == BagCompression::lz4) bag.setCompression(rosbag::compression::LZ4);
  for (const BagMessage& message : messages) {
    const std::string checksum = std::to_string(std::hash<std::string>{}(message.type.definition));
    const Sent sent{message.type.name, message.type.definition, (checksum + std::string(32, '0')).substr(0, 32),
                    message.bytes};
    bag.write(message.topic, ros::Time(message.recorded_s), sent);
  }
  bag.close();
}

}  // namespace azimuth::test
