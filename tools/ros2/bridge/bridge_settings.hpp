#pragma once
#include <chrono>
#include <cstdint>
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

}  // namespace azimuth
