#pragma once
// Messages of ROS 2: the definitions that ROS 2 writes to MCAP files, messages in CDR, and MCAP records around them.

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/tools/import/ros_messages.hpp"

namespace azimuth::test {

inline const std::string kRos2Header = R"(
================================================================================
MSG: std_msgs/Header
# Two-integer timestamp that is expressed as seconds and nanoseconds.
builtin_interfaces/Time stamp
string frame_id

================================================================================
MSG: builtin_interfaces/Time
# The seconds component, valid over all int32 values.
int32 sec
uint32 nanosec
)";

inline const RosType kRos2Odometry{"nav_msgs/msg/Odometry", R"(# Includes the frame id of the pose parent.
std_msgs/Header header
string child_frame_id
geometry_msgs/PoseWithCovariance pose
geometry_msgs/TwistWithCovariance twist
)" + kRos2Header + R"(
================================================================================
MSG: geometry_msgs/PoseWithCovariance
Pose pose
float64[36] covariance
)" + kPlaceDefinition + R"(
================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
)" + kTwistDefinition};

inline const RosType kRos2Image{"sensor_msgs/msg/Image", R"(std_msgs/Header header # Header timestamp
uint32 height                # image height, that is, number of rows
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
)" + kRos2Header};

inline const RosType kRos2JointState{"sensor_msgs/msg/JointState", R"(std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
)" + kRos2Header};

/// Builds CDR bytes, little-endian. Each value is aligned to its size, counted from behind the first four bytes.
class CdrBytes {
 public:
  CdrBytes& u8(std::uint8_t value) { return bytes_ += static_cast<char>(value), *this; }
  CdrBytes& u32(std::uint32_t value) { return align(4), bytes_ += RosBytes().u32(value).bytes(), *this; }
  CdrBytes& f64(double value) { return align(8), bytes_ += RosBytes().f64(value).bytes(), *this; }
  CdrBytes& zeros(int count) {
    for (int i = 0; i < count; ++i) f64(0.0);
    return *this;
  }
  CdrBytes& text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size() + 1));
    return bytes_ += value, u8(0);
  }
  CdrBytes& data(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size()));
    return bytes_ += value, *this;
  }
  CdrBytes& header(double stamp_s, std::string_view frame) {
    const auto whole = static_cast<std::uint32_t>(stamp_s);
    return u32(whole).u32(static_cast<std::uint32_t>((stamp_s - whole) * 1e9 + 0.5)).text(frame);
  }
  std::string bytes() const { return std::string("\0\1\0\0", 4) + bytes_; }

 private:
  void align(std::size_t size) { bytes_.append((size - bytes_.size() % size) % size, '\0'); }
  std::string bytes_;
};

struct Ros2Speeds {
  double ahead_m_s = 0.0, turn_rad_s = 0.0;
};
inline std::string ros2_odometry(double stamp_s, double x_m, double y_m, double qz, double qw,
                                 const std::string& frame = "base", const Ros2Speeds& speeds = {}) {
  CdrBytes bytes;
  bytes.header(stamp_s, "odom").text(frame).f64(x_m).f64(y_m).zeros(3).f64(qz).f64(qw);
  return bytes.zeros(36).f64(speeds.ahead_m_s).zeros(4).f64(speeds.turn_rad_s).zeros(36).bytes();
}
inline std::string ros2_joints(double stamp_s, const std::vector<std::pair<std::string, double>>& joints) {
  CdrBytes bytes;
  bytes.header(stamp_s, "").u32(static_cast<std::uint32_t>(joints.size()));
  for (const auto& joint : joints) bytes.text(joint.first);
  bytes.u32(static_cast<std::uint32_t>(joints.size()));
  for (const auto& joint : joints) bytes.f64(joint.second);
  return bytes.u32(0).u32(0).bytes();
}

inline std::string ros2_image(double stamp_s, std::uint32_t width, std::uint32_t height, std::string_view encoding,
                              std::uint32_t step, std::string_view data) {
  CdrBytes bytes;
  bytes.header(stamp_s, "camera").u32(height).u32(width).text(encoding).u8(0).u32(step).data(data);
  return bytes.bytes();
}

// Parts of MCAP files.

inline std::string mcap_u16(std::uint16_t value) {
  return {static_cast<char>(value & 0xff), static_cast<char>(value >> 8U)};
}
inline std::string mcap_u32(std::uint32_t value) { return RosBytes().u32(value).bytes(); }
inline std::string mcap_u64(std::uint64_t value) {
  return mcap_u32(static_cast<std::uint32_t>(value)) + mcap_u32(static_cast<std::uint32_t>(value >> 32U));
}
inline std::string mcap_text(const std::string& value) { return RosBytes().text(value).bytes(); }

inline std::string mcap_record(char op, const std::string& content) { return op + mcap_u64(content.size()) + content; }

inline const std::string kMcapBegin = "\x89MCAP0\r\n" + mcap_record(1, mcap_text("ros2") + mcap_text("a test"));
inline const std::string kMcapEnd =
    mcap_record(15, mcap_u32(0)) + mcap_record(2, mcap_u64(0) + mcap_u64(0) + mcap_u32(0)) + "\x89MCAP0\r\n";

inline std::string mcap_schema(std::uint16_t id, const RosType& type, const std::string& encoding = "ros2msg") {
  return mcap_record(3, mcap_u16(id) + mcap_text(type.name) + mcap_text(encoding) + mcap_text(type.definition));
}
inline std::string mcap_channel(std::uint16_t id, std::uint16_t schema, const std::string& topic,
                                const std::string& encoding = "cdr", const std::string& sender = "") {
  std::string said = mcap_text("offered_qos_profiles") + mcap_text("- history: 3");
  if (!sender.empty()) said += mcap_text("callerid") + mcap_text(sender);
  return mcap_record(4, mcap_u16(id) + mcap_u16(schema) + mcap_text(topic) + mcap_text(encoding) + mcap_text(said));
}
inline std::string mcap_message(std::uint16_t channel, double recorded_s, const std::string& data) {
  const auto ns = static_cast<std::uint64_t>(recorded_s * 1e9 + 0.5);
  return mcap_record(5, mcap_u16(channel) + mcap_u32(0) + mcap_u64(ns) + mcap_u64(ns) + data);
}
/// A chunk. `packed` is `records` compressed by `compression`. `checksum` is that of `records`; 0 means none.
inline std::string mcap_chunk(const std::string& records, const std::string& compression, const std::string& packed,
                              std::uint32_t checksum = 0) {
  return mcap_record(6, mcap_u64(1) + mcap_u64(2) + mcap_u64(records.size()) + mcap_u32(checksum) +
                            mcap_text(compression) + mcap_u64(packed.size()) + packed);
}

}  // namespace azimuth::test
