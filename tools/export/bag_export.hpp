#pragma once
#include "tools/export/estimated.hpp"

namespace azimuth {

/// A bag of ROS 1: see kRecordedTopics. `azimuth import` reads it, as do ROS's own tools. No bag where a stamp is none
/// of ROS 1's.
Exported bag_bytes(const Estimated& estimated);

}  // namespace azimuth
