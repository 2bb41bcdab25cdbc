#pragma once
#include <functional>
#include <optional>
#include <string>

#include "ros2/bridge/bridge_settings.hpp"

namespace azimuth {

/// The command line of azimuth-ros2, and what ROS 2 has in the environment.
struct Ros2Options {
  BridgeSettings bridge;
  unsigned domain = 0;    ///< --domain, else ROS_DOMAIN_ID
  std::string interface;  ///< to be used alone; empty: as the DDS library chooses, or CYCLONEDDS_URI says
};

/// Either options, or the exit code to end with (help, version, a wrong option).
struct ParsedRos2Options {
  Ros2Options options;
  std::optional<int> exit_code;
};

/// The value of a variable; empty: it is not set.
using Environment = std::function<std::string(const char* name)>;

/// Prints help, version and errors itself. ROS_LOCALHOST_ONLY=1 and ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST mean the
/// interface lo, unless another is named.
ParsedRos2Options parse_ros2_options(int argc, const char* const* argv, const Environment& environment);

}  // namespace azimuth
