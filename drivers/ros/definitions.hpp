#pragma once
// The definitions of the ROS messages, which recordings carry with them. Thread contract: reentrant.

#include <cstdint>
#include <string>
#include <string_view>

namespace azimuth::ros {

/// The messages that are written.
enum class Type : std::uint8_t { pose, odometry, transforms, path, markers, diagnostics };

/// A type in the notation of ROS 1's bags.
struct Ros1Type {
  std::string_view name;      ///< nav_msgs/Path
  std::string_view checksum;  ///< MD5 of the definition without comments
  std::string definition;     ///< definition of the type and of all types that it contains
};
Ros1Type ros1_type(Type type);

/// A type in the notation of ROS 2 and MCAP (schema encoding ros2msg).
struct Ros2Type {
  std::string_view name;   ///< nav_msgs/msg/Path
  std::string definition;  ///< definition of the type and of all types that it contains
};
Ros2Type ros2_type(Type type);

}  // namespace azimuth::ros
