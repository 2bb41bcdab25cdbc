#pragma once
// What the messages of ROS 2 are made of that a run can be made of: databases carried no definitions before Iron.

#include <string>
#include <string_view>

namespace azimuth {

/// For RosDefinition; empty: of another type. `type` is sensor_msgs/Image.
std::string known_definition(std::string_view type);

}  // namespace azimuth
