#pragma once
// The messages of ROS that a run can be made of, whatever version of their definitions a bag carries.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/bag/ros_definition.hpp"

namespace azimuth {

/// The values of one message, by their paths. Thread contract: thread-bound.
class RosMessage {
 public:
  explicit RosMessage(RosDefinition definition) : definition_(std::move(definition)) {}

  /// Borrows the bytes until the next call; false when they end early.
  bool read(Bytes message);

  // Nothing when there is no such value, or one of another type.
  std::optional<double> number(std::string_view path, std::size_t index = 0) const;
  std::optional<std::string_view> text(std::string_view path) const;
  std::optional<Bytes> bytes(std::string_view path) const;  ///< of uint8[]
  /// To the nearest microsecond, of `time` or, in ROS 2, builtin_interfaces/Time; nothing when it is zero, as where
  /// nobody set it, or before 1970.
  std::optional<Stamp> time(std::string_view path) const;
  bool has(std::string_view path) const { return values_.find(path) != values_.end(); }

 private:
  const RosDefinition::Value* find(std::string_view path) const;

  RosDefinition definition_;
  std::map<std::string, RosDefinition::Value, std::less<>> values_;
};

/// Of nav_msgs/Odometry, geometry_msgs/PoseStamped or PoseWithCovarianceStamped; nothing when it cannot be true.
std::optional<Pose2> pose_of(const RosMessage& message);

/// An image as it lies in its message.
struct RosImage {
  ImageView image;  ///< of sensor_msgs/CompressedImage mjpeg, also when it is PNG; no bytes: there is none to be read
  std::string unsupported = {};  ///< the encoding, when nothing here can read it
};
RosImage image_of(const RosMessage& message);

/// Angles of two wheels in sensor_msgs/JointState.
struct WheelAngles {
  double left_rad = 0.0;
  double right_rad = 0.0;
};
/// Of the joints with those names. Empty names: of the two joints that have left and right in their names.
std::optional<WheelAngles> wheels_of(const RosMessage& message, std::string_view left, std::string_view right);

}  // namespace azimuth
