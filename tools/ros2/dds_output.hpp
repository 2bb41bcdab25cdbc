#pragma once
// Publishes by Cyclone DDS with ROS 2's names and qualities of service.

#include <array>
#include <cstdint>
#include <dds/dds.h>
#include <functional>
#include <ros2_messages.h>
#include <string>
#include <vector>

#include "drivers/ros/messages.hpp"
#include "tools/ros2/bridge/ros_output.hpp"

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

/// Sends each message on its topic: rt/ and the name, reliable, volatile, keeping the newest ten messages (transforms:
/// a hundred, as tf2 does). No subscriber is required. A message that cannot be sent is counted for its topic, and the
/// beginning and the end of such trouble are reported.
///
/// Thread contract: thread-bound; the library has threads of its own.
class DdsOutput : public RosOutput {
 public:
  using Tell = std::function<void(const std::string& sentence)>;

  /// Uses only `interface`, unless it is empty.
  DdsOutput(unsigned domain, const std::string& interface, Tell tell);
  ~DdsOutput() override;
  DdsOutput(const DdsOutput&) = delete;
  DdsOutput& operator=(const DdsOutput&) = delete;

  /// Why nothing can be sent at all; empty: sending is possible.
  const std::string& trouble() const { return trouble_; }

  void send(const ros::PoseWithCovarianceStamped& message) override;
  void send(const ros::Odometry& message) override;
  void send(const ros::TransformMessage& message) override;
  void send(const ros::Path& message) override;
  void send(const ros::MarkerArray& message) override;
  void send(const ros::DiagnosticArray& message) override;

  /// Reports topics that have got their first subscriber, or lost their last one.
  void turn();

  /// The messages that were not sent: "/tf: 3 (timeout)"; empty: all were sent.
  std::string failures();

 private:
  /// The writer of one topic.
  struct Writer {
    const char* topic = "";
    dds_entity_t entity = 0;
    bool is_heard = false;       // it has a subscriber
    std::uint64_t failures = 0;  // messages that could not be sent
    std::string last_failure;
    bool is_failing = false;
  };

  Writer make_writer(const dds_topic_descriptor_t& type, const char* topic, int depth);
  void note(Writer& writer, dds_return_t result);
  template <class Message>
  void write(Writer& writer, const Message& message);
  std::array<Writer*, 6> writers();

  Tell tell_;
  std::string trouble_;
  DdsStorage storage_;
  dds_entity_t participant_ = 0;
  Writer pose_, odometry_, transforms_, path_, landmarks_, diagnostics_;
};

}  // namespace azimuth
