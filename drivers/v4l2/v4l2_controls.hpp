#pragma once
// Internal to drivers/v4l2: exposure, gain and the like.

#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_handle.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"

namespace azimuth::v4l2 {

/// Sets what is asked for and reads it back; what the camera has otherwise goes to `refused`, one sentence each. That a
/// camera without a control cannot decide by itself either is no news.
void apply_controls(const Handle& handle, const V4l2Settings& settings, std::vector<std::string>& refused);

}  // namespace azimuth::v4l2
