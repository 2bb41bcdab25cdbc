#pragma once
// The table [fastslam] of azimuth.toml.

#include "settings/configuration.hpp"

namespace azimuth {

Section fastslam_section(FastSlamSettings& fastslam, FastSlamPreset& preset);

/// The preset's values.
FastSlamSettings fastslam_preset(FastSlamPreset preset);

}  // namespace azimuth
