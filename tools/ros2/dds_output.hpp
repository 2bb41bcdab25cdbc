#pragma once
// Publishes by Cyclone DDS with ROS 2's names and qualities of service.

#include <array>
#include <cstdint>
#include <dds/dds.h>
#include <functional>
#include <string>

#include "tools/ros2/bridge/ros_output.hpp"
#include "tools/ros2/dds_messages.hpp"

namespace azimuth {

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
