#pragma once
// The table [lamps] of azimuth.toml.

#include "settings/section.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"

namespace azimuth {

Section lamps_section(LampSettings& lamps);

}  // namespace azimuth
