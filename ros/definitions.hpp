#pragma once
// What the messages are made of, as recordings carry it with them. Reentrant.

#include <cstdint>
#include <string>
#include <string_view>

namespace azimuth::ros {

/// Of the messages that are written.
enum class Type : std::uint8_t { pose, odometry, transforms, path, markers, diagnostics };

/// A type as ROS 1's bags say it.
struct Ros1Type {
  std::string_view name;      ///< nav_msgs/Path
  std::string_view checksum;  ///< MD5 of the definition, without comments
  std::string definition;     ///< of it and of all that it is made of
};
Ros1Type ros1_type(Type type);

/// A type as ROS 2 and MCAP say it (schema encoding ros2msg).
struct Ros2Type {
  std::string_view name;   ///< nav_msgs/msg/Path
  std::string definition;  ///< of it and of all that it is made of
};
Ros2Type ros2_type(Type type);

}  // namespace azimuth::ros
