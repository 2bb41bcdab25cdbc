#pragma once
// Exposure, gain and other features. Internal to drivers/iidc.

#include <string>
#include <vector>

#include "drivers/iidc/iidc_camera.hpp"

namespace azimuth::iidc {

/// Sets every feature that the settings name, and reads it back. Each difference becomes a sentence in `refused`; it
/// never makes the camera unusable. Thread contract: reentrant, for different cameras.
void set_features(const OpenCamera& camera, const IidcSettings& settings, std::vector<std::string>& refused);

}  // namespace azimuth::iidc
