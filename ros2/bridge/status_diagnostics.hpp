#pragma once
#include <azimuth/status_t.hpp>
#include <vector>

#include "ros/messages.hpp"

namespace azimuth {

/// A daemon's status in the form of ROS's diagnostics: of the pose, of samples and images, of devices and the process.
std::vector<ros::DiagnosticStatus> diagnostics_of(const status_t& status);

}  // namespace azimuth
