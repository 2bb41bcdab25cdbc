#pragma once
// The messages of ROS that a run can be made of, whatever version of their definitions a bag carries.

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
/// Whether its orientation was never set: all zeros, which is no rotation.
bool has_unset_orientation(const RosMessage& message);

/// Of nav_msgs/Odometry: how fast the robot drives ahead and turns; nothing when it cannot be true.
struct RosTwist {
  double speed_m_s = 0.0, turn_rad_s = 0.0;
};
std::optional<RosTwist> twist_of(const RosMessage& message);

/// "odom -> base_link": the frames that a message names.
std::string frames_of(const RosMessage& message);

/// An image as it lies in its message, or what became of it: nothing here reads transparency or 16 bits.
struct RosImage {
  ImageView image;  ///< of sensor_msgs/CompressedImage mjpeg, also when it is PNG; no bytes: there is none to be read
  std::string unsupported = {};  ///< the encoding, when nothing here can read it
};
/// `changed` holds the bytes of those that are not as they lie in the message.
RosImage image_of(const RosMessage& message, std::vector<std::byte>& changed);

/// Angles of two wheels in sensor_msgs/JointState.
struct WheelAngles {
  double left_rad = 0.0;
  double right_rad = 0.0;
};
/// Of the joints with those names. Empty names: of the two joints that have left and right in their names.
std::optional<WheelAngles> wheels_of(const RosMessage& message, std::string_view left, std::string_view right);
/// "arm, wheel_left, wheel_right".
std::string joints_of(const RosMessage& message);

}  // namespace azimuth
