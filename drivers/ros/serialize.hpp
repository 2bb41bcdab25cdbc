#pragma once
// Messages as bytes of ROS 1 and ROS 2. put() writes the part that both have in common: the members of a message in
// order. They differ in numbers (ROS 2 aligns them), texts (ROS 2 ends them with a zero), the beginning of a header
// (ROS 1 has a sequence number), and markers (ROS 2 has additional members).

#include <cstdint>
#include <string>

#include "drivers/ros/messages.hpp"

namespace azimuth::ros {

/// The parts of a time: whole seconds, rounded down, and the rest.
struct RosTime {
  std::int64_t seconds = 0;
  std::uint32_t nanoseconds = 0;
};
RosTime ros_time(Stamp stamp);

/// The time in a message. An instant 0 becomes the first nanosecond, because ROS treats 0 as an unset time.
RosTime message_time(Stamp stamp);

/// True: the time can be represented. ROS 1 has unsigned seconds in 32 bits; ROS 2 has signed seconds, of which
/// recordings use those since 1970.
bool fits_ros1(Stamp stamp);
bool fits_ros2(Stamp stamp);

// Bytes of ROS 1 as in its bags: little-endian, without padding. Stamps must fit (fits_ros1()).
std::string ros1_bytes(const PoseWithCovarianceStamped& message);
std::string ros1_bytes(const Odometry& message);
std::string ros1_bytes(const TransformMessage& message);
std::string ros1_bytes(const Path& message);
std::string ros1_bytes(const MarkerArray& message);
std::string ros1_bytes(const DiagnosticArray& message);

// CDR (XCDR1) of ROS 2, little-endian, after its header of four bytes. Stamps must fit (fits_ros2()).
std::string ros2_bytes(const PoseWithCovarianceStamped& message);
std::string ros2_bytes(const Odometry& message);
std::string ros2_bytes(const TransformMessage& message);
std::string ros2_bytes(const Path& message);
std::string ros2_bytes(const MarkerArray& message);
std::string ros2_bytes(const DiagnosticArray& message);

}  // namespace azimuth::ros
