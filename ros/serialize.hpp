#pragma once
// Messages as the bytes that ROS 1 and ROS 2 make of them. What both have alike stands once, in put(): a message is its
// members in their order. They differ in numbers (ROS 2 aligns them), texts (ROS 2 ends them with a zero), what a
// header begins with (ROS 1 has a sequence number), and in markers, to which ROS 2 has added.

#include <cstdint>
#include <string>

#include "ros/messages.hpp"

namespace azimuth::ros {

/// The parts of a time: whole seconds, rounded down, and what is left.
struct RosTime {
  std::int64_t seconds = 0;
  std::uint32_t nanoseconds = 0;
};
RosTime ros_time(Stamp stamp);

/// As messages say it: an instant 0, which ROS takes for one that nobody set, becomes the first nanosecond.
RosTime message_time(Stamp stamp);

/// Whether a time can be said: ROS 1 has unsigned seconds in 32 bits, ROS 2 signed ones, of which recordings use those
/// since 1970.
bool fits_ros1(Stamp stamp);
bool fits_ros2(Stamp stamp);

// Bytes of ROS 1, as they are in its bags: little-endian, nothing between values. Stamps must fit.
std::string ros1_bytes(const PoseWithCovarianceStamped& message);
std::string ros1_bytes(const Odometry& message);
std::string ros1_bytes(const TransformMessage& message);
std::string ros1_bytes(const Path& message);
std::string ros1_bytes(const MarkerArray& message);
std::string ros1_bytes(const DiagnosticArray& message);

// CDR (XCDR1) of ROS 2, little-endian, behind its header of four bytes. Stamps must fit.
std::string ros2_bytes(const PoseWithCovarianceStamped& message);
std::string ros2_bytes(const Odometry& message);
std::string ros2_bytes(const TransformMessage& message);
std::string ros2_bytes(const Path& message);
std::string ros2_bytes(const MarkerArray& message);
std::string ros2_bytes(const DiagnosticArray& message);

}  // namespace azimuth::ros
