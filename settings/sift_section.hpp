#pragma once
// The table [sift] of azimuth.toml.

#include "settings/configuration.hpp"

namespace azimuth {

Section sift_section(SiftSettings& sift, Preset& preset);

}  // namespace azimuth
