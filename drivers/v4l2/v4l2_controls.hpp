#pragma once
// Internal to drivers/v4l2: exposure, gain and other controls.

#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_handle.hpp"
#include "drivers/v4l2/v4l2_settings.hpp"

namespace azimuth::v4l2 {

/// Sets the requested controls and reads them back. Each difference becomes a sentence in `refused`. A missing control
/// is not reported if it was to be automatic.
void apply_controls(const Handle& handle, const V4l2Settings& settings, std::vector<std::string>& refused);

}  // namespace azimuth::v4l2
