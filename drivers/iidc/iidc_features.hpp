#pragma once
// Exposure, gain and the like. Internal to drivers/iidc.

#include <string>
#include <vector>

#include "drivers/iidc/iidc_camera.hpp"

namespace azimuth::iidc {

/// Sets every feature that the settings name and reads it back; what differs becomes a sentence in `refused`. No
/// feature is worth refusing the camera.
/// Thread contract: reentrant, for different cameras.
void set_features(const OpenCamera& camera, const IidcSettings& settings, std::vector<std::string>& refused);

}  // namespace azimuth::iidc
