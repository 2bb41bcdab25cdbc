#include "tools/export/mcap_export.hpp"

#include <vector>

#include "drivers/ros/serialize.hpp"
#include "tools/bag/mcap_writer.hpp"
#include "tools/export/ros_recording.hpp"

namespace azimuth {
namespace {

/// One channel per topic, in the order of kRecordedTopics. The profile requires the metadata key for the quality of
/// service; with an empty value, players use the default.
std::vector<std::uint16_t> add_channels(McapWriter& mcap) {
  std::vector<std::uint16_t> channels;
  for (const RecordedTopic& topic : kRecordedTopics) {
    const ros::Ros2Type type = ros::ros2_type(topic.type);
    const std::uint16_t schema = mcap.add_schema(type.name, "ros2msg", type.definition);
    channels.push_back(mcap.add_channel(schema, topic.name, "cdr", {{"offered_qos_profiles", ""}}));
  }
  return channels;
}

}  // namespace

Exported mcap_bytes(const Estimated& estimated) {
  const RecordedSpan span = recorded_span(estimated);
  if (!ros::fits_ros2(span.first) || !ros::fits_ros2(span.last))
    return tl::unexpected<std::string>("its stamps are not between 1970 and 2038, and ROS 2 counts no others");
  McapWriter mcap("ros2", "azimuth");
  const std::vector<std::uint16_t> channels = add_channels(mcap);
  record_for_ros(estimated, [&](Stamp stamp, const RecordedMessage& message) {
    const std::string bytes = std::visit([](const auto& each) { return ros::ros2_bytes(each); }, message);
    mcap.message(channels[message.index()], 1000 * static_cast<std::uint64_t>(to_us(stamp)), bytes);
  });
  return mcap.finish();
}

}  // namespace azimuth
