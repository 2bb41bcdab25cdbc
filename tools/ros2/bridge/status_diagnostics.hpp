#pragma once
#include <azimuth/status_t.hpp>
#include <vector>

#include "drivers/ros/messages.hpp"

namespace azimuth {

/// A daemon's status as ROS diagnostics: pose, samples and images, devices, and the process.
std::vector<ros::DiagnosticStatus> diagnostics_of(const status_t& status);

}  // namespace azimuth
