#pragma once
// What was estimated as a recording of ROS: which message on which topic, and when.

#include <array>
#include <functional>
#include <string_view>
#include <variant>

#include "ros/definitions.hpp"
#include "ros/make_messages.hpp"
#include "ros/messages.hpp"
#include "tools/export/estimated.hpp"

namespace azimuth {

struct RecordedTopic {
  std::string_view name;
  ros::Type type;
};

/// As a robot with ROS has them. The places in this table are those of RecordedMessage.
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

/// Calls `use` for each message, in the order of their times. Path and map, which are those known at the end, come with
/// the first pose, so that a viewer shows them from there on. Odometry and frames are left out where nobody knows
/// odometry, and diagnostics where nobody knows the health; those come when the health changes, and once a second.
void record_for_ros(const Estimated& estimated, const UseRecorded& use);

/// The first and last time of its messages.
struct RecordedSpan {
  Stamp first{}, last{};
};
RecordedSpan recorded_span(const Estimated& estimated);

}  // namespace azimuth
