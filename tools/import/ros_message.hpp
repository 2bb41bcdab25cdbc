#pragma once
// Reads the ROS messages that the import uses, independent of the version of their definitions.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/bag/ros_definition.hpp"

namespace azimuth {

/// Access to the values of one message by path. Thread contract: thread-bound.
class RosMessage {
 public:
  explicit RosMessage(RosDefinition definition) : definition_(std::move(definition)) {}

  /// Reads a message. Borrows the bytes until the next call. False if the bytes end too early.
  bool read(Bytes message);

  // The result is nothing if the value does not exist or has another type.
  std::optional<double> number(std::string_view path, std::size_t index = 0) const;
  std::optional<std::string_view> text(std::string_view path) const;
  std::optional<Bytes> bytes(std::string_view path) const;  ///< for uint8[]
  /// A `time` or, in ROS 2, a builtin_interfaces/Time, rounded to microseconds. Nothing if it is zero (unset) or before
  /// 1970.
  std::optional<Stamp> time(std::string_view path) const;
  bool has(std::string_view path) const { return values_.find(path) != values_.end(); }

 private:
  const RosDefinition::Value* find(std::string_view path) const;

  RosDefinition definition_;
  std::map<std::string, RosDefinition::Value, std::less<>> values_;
};

/// Pose of a nav_msgs/Odometry, geometry_msgs/PoseStamped or PoseWithCovarianceStamped; nothing if it is implausible.
std::optional<Pose2> pose_of(const RosMessage& message);
/// True if the orientation was never set: an all-zero quaternion is no rotation.
bool has_unset_orientation(const RosMessage& message);

/// Forward speed and turn rate of a nav_msgs/Odometry. twist_of() returns nothing if they are implausible.
struct RosTwist {
  double speed_m_s = 0.0, turn_rad_s = 0.0;
};
std::optional<RosTwist> twist_of(const RosMessage& message);

/// The frames that a message names, for example "odom -> base_link".
std::string frames_of(const RosMessage& message);

/// An image of a message. Images with transparency or 16 bits are reduced to a supported format.
struct RosImage {
  ImageView image;  ///< format mjpeg for sensor_msgs/CompressedImage, even for PNG; no bytes if it is unreadable
  std::string unsupported = {};  ///< the encoding, if it is not supported
};
/// `changed` stores the bytes of images that are converted; other images refer to the bytes of the message.
RosImage image_of(const RosMessage& message, std::vector<std::byte>& changed);

/// Angles of two wheels in sensor_msgs/JointState.
struct WheelAngles {
  double left_rad = 0.0;
  double right_rad = 0.0;
};
/// Angles of the joints with the given names. If a name is empty, the joint whose name contains left or right is used.
std::optional<WheelAngles> wheels_of(const RosMessage& message, std::string_view left, std::string_view right);
/// The names of the joints, for example "arm, wheel_left, wheel_right".
std::string joints_of(const RosMessage& message);

}  // namespace azimuth
