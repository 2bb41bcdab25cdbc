#pragma once
// Converts estimates to a sequence of ROS messages with topics and times, and to the recordings that ROS 1 and ROS 2
// play.

#include <array>
#include <functional>
#include <string_view>
#include <variant>

#include "drivers/ros/definitions.hpp"
#include "drivers/ros/make_messages.hpp"
#include "drivers/ros/messages.hpp"
#include "tools/export/estimated.hpp"

namespace azimuth {

struct RecordedTopic {
  std::string_view name;
  ros::Type type;
};

/// Topics with the names that ROS robots commonly use. The order corresponds to the alternatives of RecordedMessage.
inline constexpr std::array<RecordedTopic, 6> kRecordedTopics{{
    {"/azimuth/pose", ros::Type::pose},
    {"/odom", ros::Type::odometry},
    {"/tf", ros::Type::transforms},
    {"/azimuth/path", ros::Type::path},
    {"/azimuth/landmarks", ros::Type::markers},
    {"/diagnostics", ros::Type::diagnostics},
}};

using RecordedMessage = std::variant<ros::PoseWithCovarianceStamped, ros::Odometry, ros::TransformMessage, ros::Path,
                                     ros::MarkerArray, ros::DiagnosticArray>;

using UseRecorded = std::function<void(Stamp stamp, const RecordedMessage& message)>;

/// Calls `use` for each message in order of time. Path and map are those known at the end; they come with the first
/// pose, so that viewers show them from the start. Odometry and transforms are omitted if odometry is unknown.
/// Diagnostics are omitted if the health is unknown; otherwise they come at each change of health and once per second.
void record_for_ros(const Estimated& estimated, const UseRecorded& use);

/// The times of the first and last message.
struct RecordedSpan {
  Stamp first{}, last{};
};
RecordedSpan recorded_span(const Estimated& estimated);

/// A ROS 1 bag with the topics kRecordedTopics. `azimuth import` and the tools of ROS read it. Fails if ROS 1 cannot
/// represent a stamp.
Exported bag_bytes(const Estimated& estimated);

/// An MCAP file with ROS 2 messages (profile ros2, CDR, schemas ros2msg) on the topics kRecordedTopics. Foxglove shows
/// it without configuration, and `ros2 bag play` plays it. Fails if ROS 2 cannot represent a stamp.
Exported mcap_bytes(const Estimated& estimated);

}  // namespace azimuth
