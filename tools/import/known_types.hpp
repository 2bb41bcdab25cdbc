#pragma once
// Built-in definitions of the ROS 2 messages that the import uses. Databases before ROS 2 Iron contain no definitions.

#include <string>
#include <string_view>

namespace azimuth {

/// The definition of a type such as sensor_msgs/Image, for RosDefinition; empty for other types.
std::string known_definition(std::string_view type);

}  // namespace azimuth
