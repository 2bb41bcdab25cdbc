#pragma once
#include "tools/export/estimated.hpp"

namespace azimuth {

/// An MCAP file with ROS 2 messages (profile ros2, CDR, schemas ros2msg) on the topics kRecordedTopics. Foxglove shows
/// it without configuration, and `ros2 bag play` plays it. Fails if ROS 2 cannot represent a stamp.
Exported mcap_bytes(const Estimated& estimated);

}  // namespace azimuth
