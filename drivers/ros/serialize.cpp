#include "drivers/ros/serialize.hpp"

#include <cassert>
#include <limits>
#include <string_view>
#include <type_traits>

#include "base/bytes.hpp"

namespace azimuth::ros {
namespace {

class Ros1Bytes {
 public:
  static constexpr bool kIsRos1 = true;

  template <class Number>
  Ros1Bytes& put(Number value) {
    bytes_.put(value);
    return *this;
  }
  Ros1Bytes& text(std::string_view value) {
    bytes_.text(value);
    return *this;
  }
  Ros1Bytes& time(Stamp stamp) {
    assert(fits_ros1(stamp));
    const RosTime time = message_time(stamp);
    return put(static_cast<std::uint32_t>(time.seconds)).put(time.nanoseconds);
  }
  std::string take() { return bytes_.take(); }

 private:
  LittleBytes bytes_;
};

class Ros2Bytes {
 public:
  static constexpr bool kIsRos1 = false;

  template <class Number>
  Ros2Bytes& put(Number value) {
    while (bytes_.size() % sizeof value != 0) bytes_.put(std::uint8_t{0});
    bytes_.put(value);
    return *this;
  }
  Ros2Bytes& text(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.raw(value).put(std::uint8_t{0});
    return *this;
  }
  Ros2Bytes& time(Stamp stamp) {
    assert(fits_ros2(stamp));
    const RosTime time = message_time(stamp);
    return put(static_cast<std::int32_t>(time.seconds)).put(time.nanoseconds);
  }
  std::string take() { return std::string("\x00\x01\x00\x00", 4) + bytes_.take(); }

 private:
  LittleBytes bytes_;
};

template <class Out>
void put(Out& out, const Header& header) {
  if constexpr (Out::kIsRos1) out.put(std::uint32_t{0});
  out.time(header.stamp).text(header.frame_id);
}

template <class Out>
void put(Out& out, const Vector3& vector) {
  out.put(vector.x).put(vector.y).put(vector.z);
}

template <class Out>
void put(Out& out, const Pose& pose) {
  put(out, pose.position);
  out.put(pose.orientation.x).put(pose.orientation.y).put(pose.orientation.z).put(pose.orientation.w);
}

template <class Out>
void put(Out& out, const Covariance& covariance) {
  for (const double value : covariance) out.put(value);
}

/// Writes the number of elements, then each element.
template <class Out, class Things>
void put_all(Out& out, const Things& things) {
  out.put(static_cast<std::uint32_t>(things.size()));
  for (const auto& thing : things) put(out, thing);
}

template <class Out>
void put(Out& out, const PoseStamped& message) {
  put(out, message.header);
  put(out, message.pose);
}

template <class Out>
void put(Out& out, const PoseWithCovarianceStamped& message) {
  put(out, message.header);
  put(out, message.pose);
  put(out, message.covariance);
}

template <class Out>
void put(Out& out, const Odometry& message) {
  put(out, message.header);
  out.text(message.child_frame_id);
  put(out, message.pose);
  put(out, message.pose_covariance);
  put(out, message.twist.linear);
  put(out, message.twist.angular);
  put(out, message.twist_covariance);
}

template <class Out>
void put(Out& out, const TransformStamped& message) {
  put(out, message.header);
  out.text(message.child_frame_id);
  put(out, message.transform);
}

template <class Out>
void put(Out& out, const TransformMessage& message) {
  put_all(out, message.transforms);
}

template <class Out>
void put(Out& out, const Path& message) {
  put(out, message.header);
  put_all(out, message.poses);
}

/// An empty texture_resource; a texture without an image and without a stamp; no uv_coordinates.
void put_no_texture(Ros2Bytes& out) {
  out.text("");
  out.put(std::int32_t{0}).put(std::uint32_t{0}).text("").text("").put(std::uint32_t{0});
  out.put(std::uint32_t{0});
}

/// An empty mesh_resource; in ROS 2 also a mesh_file without name and bytes; mesh_use_embedded_materials is false.
template <class Out>
void put_no_mesh(Out& out) {
  out.text("");
  if constexpr (!Out::kIsRos1) out.text("").put(std::uint32_t{0});
  out.put(std::uint8_t{0});
}

template <class Out>
void put(Out& out, const Marker& marker) {
  put(out, marker.header);
  out.text(marker.ns).put(marker.id).put(marker.type).put(marker.action);
  put(out, marker.pose);
  put(out, marker.scale);
  out.put(marker.color.r).put(marker.color.g).put(marker.color.b).put(marker.color.a);
  out.put(std::int32_t{0}).put(std::uint32_t{0});   // lifetime: unlimited
  out.put(std::uint8_t{0});                         // frame_locked
  out.put(std::uint32_t{0}).put(std::uint32_t{0});  // points, colors
  if constexpr (!Out::kIsRos1) put_no_texture(out);
  out.text(marker.text);
  put_no_mesh(out);
}

template <class Out>
void put(Out& out, const MarkerArray& message) {
  put_all(out, message.markers);
}

template <class Out>
void put(Out& out, const KeyValue& value) {
  out.text(value.key).text(value.value);
}

template <class Out>
void put(Out& out, const DiagnosticStatus& status) {
  out.put(status.level).text(status.name).text(status.message).text(status.hardware_id);
  put_all(out, status.values);
}

template <class Out>
void put(Out& out, const DiagnosticArray& message) {
  put(out, message.header);
  put_all(out, message.status);
}

template <class Out, class Message>
std::string bytes_of(const Message& message) {
  Out out;
  put(out, message);
  return out.take();
}

}  // namespace

RosTime ros_time(Stamp stamp) {
  constexpr std::int64_t kSecond_us = 1'000'000;
  const std::int64_t us = to_us(stamp);
  const std::int64_t seconds = us / kSecond_us - (us % kSecond_us < 0 ? 1 : 0);
  return {seconds, static_cast<std::uint32_t>(1000 * (us - seconds * kSecond_us))};
}

RosTime message_time(Stamp stamp) {
  const RosTime time = ros_time(stamp);
  return time.seconds == 0 && time.nanoseconds == 0 ? RosTime{0, 1} : time;
}

bool fits_ros1(Stamp stamp) {
  const std::int64_t seconds = ros_time(stamp).seconds;
  return seconds >= 0 && seconds <= std::numeric_limits<std::uint32_t>::max();
}

bool fits_ros2(Stamp stamp) {
  const std::int64_t seconds = ros_time(stamp).seconds;
  return seconds >= 0 && seconds <= std::numeric_limits<std::int32_t>::max();
}

std::string ros1_bytes(const PoseWithCovarianceStamped& message) { return bytes_of<Ros1Bytes>(message); }
std::string ros1_bytes(const Odometry& message) { return bytes_of<Ros1Bytes>(message); }
std::string ros1_bytes(const TransformMessage& message) { return bytes_of<Ros1Bytes>(message); }
std::string ros1_bytes(const Path& message) { return bytes_of<Ros1Bytes>(message); }
std::string ros1_bytes(const MarkerArray& message) { return bytes_of<Ros1Bytes>(message); }
std::string ros1_bytes(const DiagnosticArray& message) { return bytes_of<Ros1Bytes>(message); }

std::string ros2_bytes(const PoseWithCovarianceStamped& message) { return bytes_of<Ros2Bytes>(message); }
std::string ros2_bytes(const Odometry& message) { return bytes_of<Ros2Bytes>(message); }
std::string ros2_bytes(const TransformMessage& message) { return bytes_of<Ros2Bytes>(message); }
std::string ros2_bytes(const Path& message) { return bytes_of<Ros2Bytes>(message); }
std::string ros2_bytes(const MarkerArray& message) { return bytes_of<Ros2Bytes>(message); }
std::string ros2_bytes(const DiagnosticArray& message) { return bytes_of<Ros2Bytes>(message); }

}  // namespace azimuth::ros
