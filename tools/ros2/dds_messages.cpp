#include "tools/ros2/dds_messages.hpp"

#include <algorithm>
#include <iterator>

#include "drivers/ros/serialize.hpp"

namespace azimuth {
namespace {

/// Writing does not change the text.
char* letters(const std::string& text) { return const_cast<char*>(text.c_str()); }
char* no_letters() {
  static char empty[] = "";
  return empty;
}

/// The sequence borrows elements that belong to the storage.
template <class Sequence, class Thing>
Sequence sequence_of(std::vector<Thing>& things) {
  const auto count = static_cast<std::uint32_t>(things.size());
  return {count, count, things.data(), false};
}

std_msgs_msg_dds__Header_ header_of(const ros::Header& header) {
  const ros::RosTime time = ros::message_time(header.stamp);
  return {{static_cast<std::int32_t>(time.seconds), time.nanoseconds}, letters(header.frame_id)};
}

geometry_msgs_msg_dds__Quaternion_ quaternion_of(const ros::Quaternion& q) { return {q.x, q.y, q.z, q.w}; }
geometry_msgs_msg_dds__Vector3_ vector_of(const ros::Vector3& v) { return {v.x, v.y, v.z}; }

geometry_msgs_msg_dds__Pose_ pose_of(const ros::Pose& pose) {
  return {{pose.position.x, pose.position.y, pose.position.z}, quaternion_of(pose.orientation)};
}

geometry_msgs_msg_dds__PoseWithCovariance_ pose_of(const ros::Pose& pose, const ros::Covariance& covariance) {
  geometry_msgs_msg_dds__PoseWithCovariance_ out{};
  out.pose_ = pose_of(pose);
  std::ranges::copy(covariance, std::begin(out.covariance_));
  return out;
}

visualization_msgs_msg_dds__Marker_ marker_of(const ros::Marker& marker) {
  visualization_msgs_msg_dds__Marker_ out{};
  out.header_ = header_of(marker.header);
  out.ns_ = letters(marker.ns);
  out.id_ = marker.id;
  out.type_ = marker.type;
  out.action_ = marker.action;
  out.pose_ = pose_of(marker.pose);
  out.scale_ = vector_of(marker.scale);
  out.color_ = {marker.color.r, marker.color.g, marker.color.b, marker.color.a};
  out.text_ = letters(marker.text);
  for (char** const text : {&out.texture_resource_, &out.texture_.header_.frame_id_, &out.texture_.format_,
                            &out.mesh_resource_, &out.mesh_file_.filename_})
    *text = no_letters();
  return out;
}

}  // namespace

geometry_msgs_msg_dds__PoseWithCovarianceStamped_ dds_message(const ros::PoseWithCovarianceStamped& message,
                                                              DdsStorage&) {
  return {header_of(message.header), pose_of(message.pose, message.covariance)};
}

nav_msgs_msg_dds__Odometry_ dds_message(const ros::Odometry& message, DdsStorage&) {
  nav_msgs_msg_dds__Odometry_ out{};
  out.header_ = header_of(message.header);
  out.child_frame_id_ = letters(message.child_frame_id);
  out.pose_ = pose_of(message.pose, message.pose_covariance);
  out.twist_.twist_ = {vector_of(message.twist.linear), vector_of(message.twist.angular)};
  std::ranges::copy(message.twist_covariance, std::begin(out.twist_.covariance_));
  return out;
}

tf2_msgs_msg_dds__TFMessage_ dds_message(const ros::TransformMessage& message, DdsStorage& storage) {
  storage.transforms.clear();
  for (const ros::TransformStamped& each : message.transforms)
    storage.transforms.push_back({header_of(each.header),
                                  letters(each.child_frame_id),
                                  {vector_of(each.transform.position), quaternion_of(each.transform.orientation)}});
  return {sequence_of<decltype(tf2_msgs_msg_dds__TFMessage_::transforms_)>(storage.transforms)};
}

nav_msgs_msg_dds__Path_ dds_message(const ros::Path& message, DdsStorage& storage) {
  storage.poses.clear();
  for (const ros::PoseStamped& each : message.poses)
    storage.poses.push_back({header_of(each.header), pose_of(each.pose)});
  return {header_of(message.header), sequence_of<decltype(nav_msgs_msg_dds__Path_::poses_)>(storage.poses)};
}

visualization_msgs_msg_dds__MarkerArray_ dds_message(const ros::MarkerArray& message, DdsStorage& storage) {
  storage.markers.clear();
  for (const ros::Marker& each : message.markers) storage.markers.push_back(marker_of(each));
  return {sequence_of<decltype(visualization_msgs_msg_dds__MarkerArray_::markers_)>(storage.markers)};
}

diagnostic_msgs_msg_dds__DiagnosticArray_ dds_message(const ros::DiagnosticArray& message, DdsStorage& storage) {
  storage.statuses.clear();
  storage.values.resize(message.status.size());
  for (std::size_t i = 0; i < message.status.size(); ++i) {
    const ros::DiagnosticStatus& status = message.status[i];
    storage.values[i].clear();
    for (const ros::KeyValue& each : status.values)
      storage.values[i].push_back({letters(each.key), letters(each.value)});
    storage.statuses.push_back(
        {status.level, letters(status.name), letters(status.message), letters(status.hardware_id),
         sequence_of<decltype(diagnostic_msgs_msg_dds__DiagnosticStatus_::values_)>(storage.values[i])});
  }
  return {header_of(message.header),
          sequence_of<decltype(diagnostic_msgs_msg_dds__DiagnosticArray_::status_)>(storage.statuses)};
}

}  // namespace azimuth
