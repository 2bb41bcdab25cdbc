#pragma once
#include "ros/messages.hpp"

namespace azimuth {

/// Where messages of ROS go. What cannot be sent is the output's to count and to tell of.
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
