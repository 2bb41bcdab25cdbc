#pragma once
// Messages of ROS 1 as bags contain them: the definitions of ROS 1 and the serialised bytes.

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace azimuth::test {

struct RosType {
  std::string name, definition;
};

inline const std::string kHeaderDefinition = R"(
================================================================================
MSG: std_msgs/Header
# Standard metadata for higher-level stamped data types.
uint32 seq
#Two-integer timestamp
time stamp
string frame_id
)";

inline const std::string kPlaceDefinition = R"(
================================================================================
MSG: geometry_msgs/Pose
# A representation of pose in free space, composed of position and orientation.
Point position
Quaternion orientation

================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
)";

inline const std::string kPoseDefinition = kPlaceDefinition + R"(
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
)";

inline const std::string kTwistDefinition = R"(
================================================================================
MSG: geometry_msgs/TwistWithCovariance
Twist twist
float64[36] covariance

================================================================================
MSG: geometry_msgs/Twist
Vector3  linear
Vector3  angular

================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
)";

inline const RosType kOdometryType{"nav_msgs/Odometry", R"(# The pose should be in header.frame_id
Header header
string child_frame_id
geometry_msgs/PoseWithCovariance pose
geometry_msgs/TwistWithCovariance twist
)" + kHeaderDefinition + R"(
================================================================================
MSG: geometry_msgs/PoseWithCovariance
Pose pose
# Row-major representation of the 6x6 covariance matrix
float64[36] covariance
)" + kPoseDefinition + kTwistDefinition};

inline const RosType kPoseStampedType{"geometry_msgs/PoseStamped",
                                      "Header header\nPose pose\n" + kHeaderDefinition + kPoseDefinition};

inline const RosType kImageType{"sensor_msgs/Image",
                                R"(Header header        # Header timestamp should be acquisition time
uint32 height         # image height, that is, number of rows
uint32 width
string encoding       # Encoding of pixels
uint8 is_bigendian
uint32 step           # Full row length in bytes
uint8[] data
)" + kHeaderDefinition};

inline const RosType kCompressedImageType{"sensor_msgs/CompressedImage", R"(Header header
string format        # Specifies the format of the data
uint8[] data
)" + kHeaderDefinition};

inline const RosType kJointStateType{"sensor_msgs/JointState", R"(Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
)" + kHeaderDefinition};

inline const RosType kTransformsType{"tf2_msgs/TFMessage", R"(geometry_msgs/TransformStamped[] transforms
================================================================================
MSG: geometry_msgs/TransformStamped
Header header
string child_frame_id
Transform transform

================================================================================
MSG: geometry_msgs/Transform
Vector3 translation
Quaternion rotation
)" + kHeaderDefinition + kPoseDefinition + kTwistDefinition};

inline const RosType kTextType{"std_msgs/String", "string data\n"};

/// Builds the serialised bytes of a ROS 1 message.
class RosBytes {
 public:
  RosBytes& u8(std::uint8_t value) { return bytes_ += static_cast<char>(value), *this; }
  RosBytes& u32(std::uint32_t value) {
    for (int i = 0; i < 4; ++i) u8(static_cast<std::uint8_t>(value >> (8 * i)));
    return *this;
  }
  RosBytes& f64(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    return u32(static_cast<std::uint32_t>(bits)).u32(static_cast<std::uint32_t>(bits >> 32U));
  }
  RosBytes& f64s(std::initializer_list<double> values) {
    for (const double value : values) f64(value);
    return *this;
  }
  RosBytes& zeros(int count) {
    for (int i = 0; i < count; ++i) f64(0.0);
    return *this;
  }
  RosBytes& text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size()));
    return bytes_ += value, *this;
  }
  RosBytes& header(double stamp_s, std::string_view frame = "odom") {
    const auto whole = static_cast<std::uint32_t>(stamp_s);
    return u32(7).u32(whole).u32(static_cast<std::uint32_t>((stamp_s - whole) * 1e9 + 0.5)).text(frame);
  }
  /// Appends position and orientation.
  RosBytes& pose(double x_m, double y_m, double qz, double qw) { return f64s({x_m, y_m, 0.0, 0.0, 0.0, qz, qw}); }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

inline std::string odometry_bytes(double stamp_s, double x_m, double y_m, double qz, double qw) {
  return RosBytes().header(stamp_s).text("base").pose(x_m, y_m, qz, qw).zeros(36 + 6 + 36).bytes();
}

inline std::string image_bytes(double stamp_s, std::uint32_t width, std::uint32_t height, std::string_view encoding,
                               std::uint32_t step, std::string_view data) {
  return RosBytes().header(stamp_s).u32(height).u32(width).text(encoding).u8(0).u32(step).text(data).bytes();
}

inline std::string compressed_bytes(double stamp_s, std::string_view format, std::string_view data) {
  return RosBytes().header(stamp_s).text(format).text(data).bytes();
}

inline std::string joints_bytes(double stamp_s, const std::vector<std::pair<std::string, double>>& joints) {
  RosBytes bytes;
  bytes.header(stamp_s).u32(static_cast<std::uint32_t>(joints.size()));
  for (const auto& joint : joints) bytes.text(joint.first);
  bytes.u32(static_cast<std::uint32_t>(joints.size()));
  for (const auto& joint : joints) bytes.f64(joint.second);
  return bytes.u32(0).u32(0).bytes();
}

}  // namespace azimuth::test
