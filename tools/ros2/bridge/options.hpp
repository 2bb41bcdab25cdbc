#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "drivers/ros/make_messages.hpp"

namespace azimuth {

/// The transforms that are sent.
enum class TransformChoice : std::uint8_t {
  full,  ///< map to odom, and odom to the robot
  /// Only map to odom; another program sends the second transform, from the same odometry.
  map_odom,
  none
};

struct BridgeSettings {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";  ///< as [daemon.lcm] url
  std::string channel_prefix;                               ///< as [daemon.lcm] channel_prefix
  ros::Frames frames;
  TransformChoice transforms = TransformChoice::full;
  std::chrono::milliseconds silent_after{5000};  ///< silence is reported after this time without a pose
};

/// The command line of azimuth-ros2, and ROS 2's settings from the environment.
struct Ros2Options {
  BridgeSettings bridge;
  unsigned domain = 0;  ///< --domain, otherwise ROS_DOMAIN_ID
  /// The only interface to use; empty: chosen by the DDS library or CYCLONEDDS_URI.
  std::string interface;
};

/// Either the options, or the exit code with which the process is to end (after help, version or a wrong option).
struct ParsedRos2Options {
  Ros2Options options;
  std::optional<int> exit_code;
};

/// The value of an environment variable; empty: it is not set.
using Environment = std::function<std::string(const char* name)>;

/// Prints help, version and errors itself. ROS_LOCALHOST_ONLY=1 and ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST select the
/// interface lo, unless another is named.
ParsedRos2Options parse_ros2_options(int argc, const char* const* argv, const Environment& environment);

}  // namespace azimuth
