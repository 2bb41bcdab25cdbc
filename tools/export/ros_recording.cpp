#include "tools/export/ros_recording.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <vector>

#include "drivers/ros/serialize.hpp"
#include "tools/bag/bag_writer.hpp"
#include "tools/bag/mcap_writer.hpp"

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

constexpr Duration kDiagnosticsEvery = std::chrono::seconds(1);

/// Sends diagnostics at changes of health and at regular intervals.
class Diagnostics {
 public:
  void look(const EstimatedPose& pose, const UseRecorded& use) {
    if (!pose.health) return;
    const bool is_due = said_ == nullptr || pose.stamp - said_->stamp >= kDiagnosticsEvery;
    if (!is_due && said_->health == pose.health && said_->reason == pose.reason) return;
    use(pose.stamp, ros::DiagnosticArray{{pose.stamp, ""}, {ros::health_status(*pose.health, pose.reason)}});
    said_ = &pose;
  }

 private:
  const EstimatedPose* said_ = nullptr;
};

}  // namespace

void record_for_ros(const Estimated& estimated, const UseRecorded& use) {
  assert(!estimated.poses.empty());
  const ros::Frames frames;
  const Stamp begin = estimated.poses.front().stamp;
  use(begin, ros::path_message(frames, begin, path_of(estimated)));
  use(begin, ros::landmark_markers(frames, begin, estimated.landmarks));
  Diagnostics diagnostics;
  std::optional<ros::TimedPose> before;
  for (const EstimatedPose& pose : estimated.poses) {
    use(pose.stamp, ros::pose_message(frames, pose.stamp, pose.T_map_body, pose.covariance));
    if (pose.T_odom_body) {
      const ros::TimedPose now{pose.stamp, *pose.T_odom_body};
      use(pose.stamp, ros::odometry_message(frames, before, now));
      use(pose.stamp, ros::transform_message(frames, pose.stamp, pose.T_map_body, *pose.T_odom_body, true));
      before = now;
    }
    diagnostics.look(pose, use);
  }
}

RecordedSpan recorded_span(const Estimated& estimated) {
  assert(!estimated.poses.empty());
  RecordedSpan span{estimated.poses.front().stamp, estimated.poses.back().stamp};
  for (const PathPose& pose : estimated.path) {
    span.first = std::min(span.first, pose.stamp);
    span.last = std::max(span.last, pose.stamp);
  }
  return span;
}

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
