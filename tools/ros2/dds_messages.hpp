#pragma once
// ROS messages as the structures that Cyclone DDS writes.

#include <ros2_messages.h>
#include <vector>

#include "drivers/ros/messages.hpp"

namespace azimuth {

/// The storage of the structures that dds_message() returns. They borrow texts from their message, and the storage
/// until it is used again, so they are for writing only. Members that no message here uses (textures, meshes, points)
/// are empty.
struct DdsStorage {
  std::vector<geometry_msgs_msg_dds__TransformStamped_> transforms;
  std::vector<geometry_msgs_msg_dds__PoseStamped_> poses;
  std::vector<visualization_msgs_msg_dds__Marker_> markers;
  std::vector<diagnostic_msgs_msg_dds__DiagnosticStatus_> statuses;
  std::vector<std::vector<diagnostic_msgs_msg_dds__KeyValue_>> values;  // values of each status
};

geometry_msgs_msg_dds__PoseWithCovarianceStamped_ dds_message(const ros::PoseWithCovarianceStamped& message,
                                                              DdsStorage& storage);
nav_msgs_msg_dds__Odometry_ dds_message(const ros::Odometry& message, DdsStorage& storage);
tf2_msgs_msg_dds__TFMessage_ dds_message(const ros::TransformMessage& message, DdsStorage& storage);
nav_msgs_msg_dds__Path_ dds_message(const ros::Path& message, DdsStorage& storage);
visualization_msgs_msg_dds__MarkerArray_ dds_message(const ros::MarkerArray& message, DdsStorage& storage);
diagnostic_msgs_msg_dds__DiagnosticArray_ dds_message(const ros::DiagnosticArray& message, DdsStorage& storage);

}  // namespace azimuth
