#pragma once
#include "tools/export/estimated.hpp"

namespace azimuth {

/// A ROS 1 bag with the topics kRecordedTopics. `azimuth import` and the tools of ROS read it. Fails if ROS 1 cannot
/// represent a stamp.
Exported bag_bytes(const Estimated& estimated);

}  // namespace azimuth
