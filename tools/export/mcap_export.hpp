#pragma once
#include "tools/export/estimated.hpp"

namespace azimuth {

/// A file of MCAP with the messages of ROS 2 (profile ros2, CDR, schemas ros2msg): see kRecordedTopics. Foxglove shows
/// them without any set-up, and `ros2 bag play` plays them. No file where a stamp is none of ROS 2's.
Exported mcap_bytes(const Estimated& estimated);

}  // namespace azimuth
