#include "tools/export/bag_export.hpp"

#include <vector>

#include "drivers/ros/serialize.hpp"
#include "tools/bag/bag_writer.hpp"
#include "tools/export/ros_recording.hpp"

namespace azimuth {
namespace {

/// One connection per topic, in the order of kRecordedTopics.
std::vector<std::uint32_t> connect_all(BagWriter& bag) {
  std::vector<std::uint32_t> connections;
  for (const RecordedTopic& topic : kRecordedTopics) {
    const ros::Ros1Type type = ros::ros1_type(topic.type);
    connections.push_back(bag.connect({.id = 0,
                                       .topic = std::string(topic.name),
                                       .type = std::string(type.name),
                                       .definition = type.definition,
                                       .checksum = std::string(type.checksum)}));
  }
  return connections;
}

BagTime bag_time(Stamp stamp) {
  const ros::RosTime time = ros::message_time(stamp);  // the player of ROS skips messages at time 0
  return {static_cast<std::uint32_t>(time.seconds), time.nanoseconds};
}

}  // namespace

Exported bag_bytes(const Estimated& estimated) {
  const RecordedSpan span = recorded_span(estimated);
  if (!ros::fits_ros1(span.first) || !ros::fits_ros1(span.last))
    return tl::unexpected<std::string>("its stamps are not between 1970 and 2106, and ROS 1 counts no others");
  BagWriter bag;
  const std::vector<std::uint32_t> connections = connect_all(bag);
  record_for_ros(estimated, [&](Stamp stamp, const RecordedMessage& message) {
    const std::string bytes = std::visit([](const auto& each) { return ros::ros1_bytes(each); }, message);
    bag.message(connections[message.index()], bag_time(stamp), bytes);
  });
  return bag.finish();
}

}  // namespace azimuth
