#pragma once
#include "drivers/ros/messages.hpp"

namespace azimuth {

/// The destination of ROS messages. The output counts and reports messages that cannot be sent.
///
/// Thread contract: thread-bound.
class RosOutput {
 public:
  virtual ~RosOutput() = default;
  virtual void send(const ros::PoseWithCovarianceStamped& message) = 0;
  virtual void send(const ros::Odometry& message) = 0;
  virtual void send(const ros::TransformMessage& message) = 0;
  virtual void send(const ros::Path& message) = 0;
  virtual void send(const ros::MarkerArray& message) = 0;
  virtual void send(const ros::DiagnosticArray& message) = 0;
};

}  // namespace azimuth
