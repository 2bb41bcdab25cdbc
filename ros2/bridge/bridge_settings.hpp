#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "ros/make_messages.hpp"

namespace azimuth {

/// Which transforms are sent.
enum class TransformChoice : std::uint8_t {
  full,      ///< map to odom, odom to the robot
  map_odom,  ///< the second is sent by somebody else, of the very same odometry
  none
};

struct BridgeSettings {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";  ///< as [daemon.lcm] url
  std::string channel_prefix;                               ///< as [daemon.lcm] channel_prefix
  ros::Frames frames;
  TransformChoice transforms = TransformChoice::full;
  std::chrono::milliseconds silent_after{5000};  ///< without a pose, of which is told then
};

}  // namespace azimuth
